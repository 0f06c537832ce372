// SPDX-License-Identifier: MIT
#pragma once

// Occlusion by discs at the texels of a map that lies on all surfaces.

#include "techniques/occlusion/discs/discs.hpp"

namespace estampe::occlusion {

/// What was found last for a map's texels: it outlives a frame.
struct DiscMapBuffers {
    gpu::Buffer found; ///< four floats a texel: what is thrown on it, and what is open; -1 off the surface
    uint32_t size = 0; ///< texels a side
    bool is_found = false; ///< for the pose and the style in hand
    float radius_m = 0.0F; ///< of that
    bool has_thrown = false;
};

/// Of a map of so many texels a side.
[[nodiscard]] DiscMapBuffers make_disc_map(gpu::Device& device, uint32_t size);

struct DiscMapInputs {
    gpu::BufferId map_texels; ///< see shaders/surface_map.glsl
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
};

/// The sum of add_discs() at the middle of each texel. Kept until something moves.
///
/// Returns four floats a texel, row by row, as DiscMapBuffers has them
/// Cost    texels times the logarithm of the discs, and the tree
/// Source  as add_discs(); to a texture as the thesis has it
[[nodiscard]] gpu::BufferId add_disc_map(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                                         const DiscMapInputs& in, const DiscSettings& settings);

struct DiscMapPageInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId map_corners; ///< see shaders/map_corners.glsl
    gpu::BufferId found;       ///< by add_disc_map()
    uint32_t map_size = 0;     ///< texels a side
    bool throws = false;       ///< light that discs throw was found too
    glm::uvec2 size_px{0};
};

/// The same for each pixel, as add_disc_page() gives it, between texels. Cost: one full-screen dispatch.
[[nodiscard]] OpenPage add_disc_map_page(gpu::Graph& graph, const DiscMapPageInputs& in,
                                         const OcclusionStyle& style);

} // namespace estampe::occlusion
