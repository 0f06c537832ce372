// SPDX-License-Identifier: MIT
#pragma once

// From identities to surfaces: what is seen at each pixel, as images that all later techniques read.

#include <array>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"

namespace estampe::surface {

/// What a scene needs of the shaders; the rest is left out of them.
struct SceneNeeds {
    uint32_t texture_classes = 0; ///< a bit for each size class that holds textures
    bool normal_maps = false;
    bool occlusion = false; ///< some material has an occlusion texture
    bool vertex_colors = false;
    bool second_uvs = false;
    bool emissive = false;
    bool own_outlines = false; ///< some material brings an outline of its own
    bool moves = false;        ///< has animations, skins or morph targets
};

struct ResolveInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId stroke_coordinates;
    gpu::BufferId stroke_kinds;     ///< one a draw, see shaders/stroke_kind.glsl.h
    gpu::BufferId form_coordinates; ///< three a triangle; read where a kind says form
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    SceneNeeds needs;
    uint32_t strokes_present = 0; ///< a bit for each kind of stroke in `stroke_kinds`
    float strokes_per_m = 1.0F;   ///< stroke coordinates a metre
    glm::uvec2 size_px{0};
};

struct Surface {
    gpu::ImageId draw;   ///< r32ui: draw + 1, 0 where nothing is
    gpu::ImageId depth;  ///< r32f: reversed, 0 where nothing is
    gpu::ImageId normal; ///< rg32ui: octahedral in two signed 16-bit parts: bent by normal maps, smooth;
                         ///< towards the eye
    gpu::ImageId color;  ///< rgba8: square root of linear colour; share of the light that occlusion lets by
    gpu::ImageId
        coordinate; ///< rgba32f: what strokes follow: two numbers and 0, or the place in the rest pose
    gpu::ImageId footprint; ///< rgba32ui: its change over a pixel, see shaders/surface_images.glsl
};

/// Cost    one full-screen dispatch; 52 bytes written a pixel
/// Source  Schied and Dachsbacher, "Deferred Attribute Interpolation for Memory-Efficient Deferred Shading",
/// 2015
[[nodiscard]] Surface add_resolve(gpu::Graph& graph, const ResolveInputs& in);

struct FarInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;  ///< Surface::depth
    glm::uvec2 size_px{0};
};

/// Lists the tiles of 8 x 8 pixels that sky may show in: where nothing is seen somewhere, or something
/// `from_m` or farther from the eye. None other has such a pixel. In parallel projection all are listed.
///
/// Writes  a list of tiles, see shaders/tiles.glsl.h
/// Cost    a thread a tile, which stops at the first such pixel
[[nodiscard]] gpu::BufferId add_far_tiles(gpu::Graph& graph, const FarInputs& in, float from_m);

} // namespace estampe::surface
