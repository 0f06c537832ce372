// SPDX-License-Identifier: MIT
#pragma once

// The two raster paths, compute and hardware, what both need, and which of them is taken; raster.hpp is what
// others call to draw.

#include <optional>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// Pairs of large triangle and tile that one draw lists at most.
inline constexpr uint64_t most_tiles = 1ULL << 18U;
/// llvmpipe ends a thread's loops after 65535 rounds in all, without a word; a tile takes 65 of them.
inline constexpr uint32_t most_tiles_a_group = 1000;

/// Zeros for `buffer`, whose size is a multiple of 16 bytes.
[[nodiscard]] gpu::BufferId add_clear(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId buffer);

/// Binds what alpha masks look up, eight bindings, in the order of mask.glsl.
void bind_masks(gpu::Pass& pass, const RasterInputs& in);

/// Draws the batches that hold triangles into `target`, 64 bits a pixel, or 32 when `depth_only`.
[[nodiscard]] gpu::BufferId draw_by_compute(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                            std::span<const Batch> batches, const View& view,
                                            gpu::BufferId target, bool depth_only);
[[nodiscard]] gpu::BufferId draw_by_hardware(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                             std::span<const Batch> batches, const View& view,
                                             gpu::BufferId target, bool depth_only);
[[nodiscard]] gpu::BufferId draw_parts_by_hardware(gpu::Graph& graph, const gpu::Name& name,
                                                   const RasterInputs& in, std::span<const Batch> batches,
                                                   const View& view, const std::vector<DepthPart>& parts,
                                                   uint32_t row_texels, gpu::BufferId map);

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
