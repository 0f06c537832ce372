// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"

namespace estampe::raster {

/// What is clear without measuring: `wanted`, unless it is automatic; hardware where compute is impossible,
/// and on a processor, where it is the quicker to start and the answer must never change. Nothing on other
/// GPUs. Throws Error when the device cannot draw as wanted.
[[nodiscard]] std::optional<RasterPath> settled_path(const DeviceInfo& device, RasterPath wanted);

/// The path to draw by, never automatic: settled_path(), or else measure_paths().
[[nodiscard]] RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted);

/// The path that draws a small scene of its own in less time. Compute, unless hardware is quicker by a fifth:
/// near a tie the answer is the same each time.
///
/// Cost    the pipelines of both paths, and four frames each of 0.1 to 1 ms
[[nodiscard]] RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor);

} // namespace estampe::raster
