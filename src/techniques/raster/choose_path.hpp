// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"

namespace estampe::raster {

/// The path to draw by, never automatic. `wanted` decides, if it is not; throws Error when the device cannot
/// draw so. Otherwise: hardware where compute is impossible; on a processor always the same, so that the same
/// command gives the same bytes; on a GPU the one that draws a small scene of its own in less time.
///
/// Cost    on a GPU two pipelines each way and a few frames of 0.1 to 1 ms; nothing else anywhere
[[nodiscard]] RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted);

/// The path that draws the built-in scene in less time. Compute, unless hardware is quicker by a fifth:
/// near a tie the answer is the same each time.
[[nodiscard]] RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor);

} // namespace estampe::raster
