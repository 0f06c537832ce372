// SPDX-License-Identifier: MIT
#pragma once

// What both raster paths need, and the paths themselves; raster.hpp is what others call.

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

/// Which pixels of a peel are drawn, as the shaders know it: see draws_second.
[[nodiscard]] uint32_t second_bits(const View& view);

/// The variant of a shader that draws a batch: what peels can test masks, and need not.
[[nodiscard]] uint32_t mask_variant(const RasterInputs& in, const Batch& batch, const View& view);

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

} // namespace estampe::raster
