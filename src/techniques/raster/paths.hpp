// SPDX-License-Identifier: MIT
#pragma once

// The compute raster path, the hardware raster path, their common functions, and the choice between them.
// Code that draws must include raster.hpp.

#include <optional>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// Most pairs of large triangle and tile in the list of one batch.
inline constexpr uint64_t most_tiles = 1ULL << 18U;
/// Most tiles that one workgroup draws. llvmpipe silently ends a thread's loops after 65535 rounds in all; a
/// tile takes 65 rounds of the loop.
inline constexpr uint32_t most_tiles_a_group = 1000;

/// Adds a pass that fills `buffer` with zeros. The buffer's size must be a multiple of 16 bytes.
[[nodiscard]] gpu::BufferId add_clear(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId buffer);

/// Binds the resources of alpha masks, eight bindings, in the order of mask.glsl.
void bind_masks(gpu::Pass& pass, const RasterInputs& in);

/// Draws the non-empty batches into `target` with the compute path: 64 bits per pixel, or 32 if `depth_only`.
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

/// The raster path that can be chosen without measuring: the path `wanted`, unless `wanted` is automatic.
/// With automatic, the path is hardware where compute is impossible. The path is also hardware on CPU
/// devices, where hardware starts faster and the answer must not change. Empty on GPUs that could use either
/// path. Throws Error if the device does not support `wanted`.
[[nodiscard]] std::optional<RasterPath> settled_path(const DeviceInfo& device, RasterPath wanted);

/// Chooses the raster path to draw with, never automatic: settled_path(), or else measure_paths().
[[nodiscard]] RasterPath choose_path(gpu::Device& device, gpu::Executor& executor, RasterPath wanted);

struct PageWork {
    uint64_t triangles = 0;
    uint64_t pixels = 0;
    bool has_masks = false; ///< some triangles have alpha masks or are transparent
};

/// Chooses the raster paths of a picture for the requested path `wanted` and choose_path()'s result `chosen`.
/// Both paths of the picture are `chosen`, with one exception. On a CPU device with `automatic`, a page with
/// at least one triangle per eight pixels is drawn by compute. There, compute draws small triangles on all
/// cores, but the driver sets up triangles on one core. With masks the path is always hardware, because
/// compiling the many masked shaders would delay the first picture.
[[nodiscard]] Paths paths_of(const DeviceInfo& device, RasterPath wanted, RasterPath chosen,
                             const PageWork& work);

/// Measures which raster path draws a small test scene faster. Returns compute unless hardware is faster by a
/// fifth, so that the answer is stable near a tie.
///
/// Cost    the pipelines of both paths, and four frames each of 0.1 to 1 ms
[[nodiscard]] RasterPath measure_paths(gpu::Device& device, gpu::Executor& executor);

} // namespace estampe::raster
