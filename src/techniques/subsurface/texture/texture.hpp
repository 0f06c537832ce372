// SPDX-License-Identifier: MIT
#pragma once

// Light that spreads in a map that lies on all surfaces, also from what the camera does not see.

#include "techniques/subsurface/subsurface.hpp"

namespace estampe::subsurface {

/// The map, see shaders/surface_map.glsl and shaders/map_corners.glsl, and what lies in it.
struct TextureInputs {
    gpu::BufferId map_texels;
    gpu::BufferId map_corners;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    gpu::BufferId looks;                       ///< SubsurfaceLook
    std::optional<gpu::BufferId> look_of_draw; ///< where there are several
    uint32_t size = 0;                         ///< texels a side
    float most_spread_tx = 1.0F;               ///< of all colours of all looks, in texels
};

/// The map as a surface for light to fall on, as large as the map.
struct TextureSurface {
    gpu::ImageId draw;   ///< r32ui: as surface has it, 0 where there is nothing
    gpu::ImageId normal; ///< rg32ui
    gpu::ImageId points; ///< rgba32f: places in anchor space, and what a texel spans there
};

/// Places the map's texels on the surface as it is posed. Cost: one dispatch over the map.
[[nodiscard]] TextureSurface add_texture_surface(gpu::Graph& graph, const TextureInputs& in);

/// Light that has spread in the map.
struct TextureLight {
    gpu::ImageId spread; ///< rgba32f: by colour, in texels
    gpu::ImageId sum;    ///< rgba32f: what comes from elsewhere; 1 where it does
};

/// Lets the `light` that falls on the map's texels spread between them, by the same profile as add_scatter().
///
/// Cost    two dispatches for each doubling of the reach in texels, and one, over the map
/// Source  d'Eon, Luebke and Enderton, "Efficient Rendering of Human Skin", 2007, and as add_scatter()
[[nodiscard]] TextureLight add_texture_scatter(gpu::Graph& graph, const TextureInputs& in,
                                               const TextureSurface& surface, gpu::ImageId light);

/// Lays it over what of `light`, the page's, stays where it is. Returns the new version of that. Cost: one
/// full-screen dispatch.
[[nodiscard]] gpu::ImageId add_texture_page(gpu::Graph& graph, const TextureInputs& in,
                                            const TextureLight& spread, gpu::BufferId frame,
                                            gpu::BufferId visibility, gpu::ImageId light, glm::uvec2 size_px);

} // namespace estampe::subsurface
