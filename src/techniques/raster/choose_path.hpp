// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// What is clear without measuring: `wanted`, unless it is automatic; hardware where compute is impossible,
/// and on a processor, where it is the quicker to start and the answer must never change. Nothing on other
/// GPUs. Throws Error when the device cannot draw as wanted.
[[nodiscard]] std::optional<RasterPath> settled_path(const DeviceInfo& device, RasterPath wanted);

/// The path to draw by, never automatic: settled_path(), or else measure_paths().
[[nodiscard]] RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted);

/// What is drawn on a page.
struct PageWork {
    uint64_t triangles = 0;
    uint64_t pixels = 0;
    bool has_masks = false; ///< some triangles have holes, or are seen through
};

/// The paths of a picture, where `wanted` was asked for and `chosen` is of choose_path(). They are the same,
/// but on a processor that was left to choose: compute for a page that has a triangle for every eight pixels
/// or fewer, as all cores draw small triangles and the driver's rasteriser sets them up on one. With masks it
/// is hardware all the same: theirs are many shaders, which a first picture waits for.
[[nodiscard]] Paths paths_of(const DeviceInfo& device, RasterPath wanted, RasterPath chosen,
                             const PageWork& work);

/// The path that draws a small scene of its own in less time. Compute, unless hardware is quicker by a fifth:
/// near a tie the answer is the same each time.
///
/// Cost    the pipelines of both paths, and four frames each of 0.1 to 1 ms
[[nodiscard]] RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor);

} // namespace estampe::raster
