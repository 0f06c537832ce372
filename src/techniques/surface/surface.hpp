// SPDX-License-Identifier: MIT
#pragma once

// Converts the visibility buffer to images of surface attributes, which all later techniques read.

#include <array>
#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"

namespace estampe::surface {

/// Features that a scene needs; shaders leave out the others.
struct SceneNeeds {
    uint32_t texture_classes = 0; ///< one bit for each class of texture sizes that holds textures
    bool normal_maps = false;
    bool occlusion = false; ///< some material has an occlusion texture
    bool vertex_colors = false;
    bool second_uvs = false;
    bool emissive = false;
    bool own_outlines = false; ///< some material has its own width of outline
    bool moves = false;        ///< the scene has animations, skins or morph targets
};

struct ResolveInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId stroke_coordinates;
    gpu::BufferId stroke_kinds;     ///< kind of strokes of each draw call, see shaders/stroke_kind.glsl.h
    gpu::BufferId form_coordinates; ///< coordinates of strokes along the form, three per triangle; read only
                                    ///< for strokes_form
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    SceneNeeds needs;
    uint32_t strokes_present = 0; ///< one bit for each kind of strokes that occurs in `stroke_kinds`
    float strokes_per_m = 1.0F;   ///< stroke coordinates per metre
    glm::uvec2 size_px{0};
};

struct Surface {
    gpu::ImageId draw;  ///< r32ui: draw call + 1 and flags, 0 for the background
    gpu::ImageId depth; ///< r32f: reversed depth, 0 for the background
    /// rg32ui: two packed normals towards the eye, octahedral in two signed 16-bit parts: first with normal
    /// maps, then smooth.
    gpu::ImageId normal;
    /// rgba8: square root of linear colour; in alpha, visibility from the occlusion texture.
    gpu::ImageId color;
    /// rgba32f: coordinate that strokes follow: two numbers and 0, or the position in the rest pose.
    gpu::ImageId coordinate;
    gpu::ImageId footprint; ///< rgba32ui: change of `coordinate` per pixel, see shaders/surface_images.glsl
};

/// Adds a pass that computes the surface attributes of all pixels.
///
/// Cost    one full-screen dispatch; 52 bytes written per pixel
/// Source  Schied and Dachsbacher, "Deferred Attribute Interpolation for Memory-Efficient Deferred Shading",
///         2015
[[nodiscard]] Surface add_resolve(gpu::Graph& graph, const ResolveInputs& in);

struct ShadeInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId records; ///< one ShadeRecord per draw call, see surface/shade.glsl.h
    std::array<gpu::ImageId, 5> textures;
    std::optional<gpu::ImageId> pictures; ///< array of the pictures that a style names; none without pictures
    gpu::ImageId draw;                    ///< Surface::draw of the visible surfaces
    gpu::ImageId normal;                  ///< Surface::normal of the visible surfaces
    /// r32f: visible share of the sun; -1 where the sun does not shine, -2 where its share is not known; read
    /// only with `has_steps`.
    gpu::ImageId sun;
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    bool has_steps = false; ///< records with a step of their own decide by the sun where the shade begins
    uint32_t texture_classes = 0;
    /// Works only in tiles of 8 x 8 pixels that show a surface with a shade colour, and lists these tiles
    /// first. For CPUs, where an empty pixel costs as much as any other.
    bool lists_tiles = false;
    glm::uvec2 size_px{0};
};

/// Adds a pass that computes the colour of visible surfaces in the shade, for cel shading with two textures.
/// With `has_steps`, a surface with a step of its own changes from shade to light where
/// `clamp((c - from) / (to - from), 0, 1)` rises from 0 to 1. Here c is the cosine of incidence, and -1 in a
/// cast shadow.
///
/// Writes  rgba16f: linear colour in the shade; alpha is the share of the lit colour, or one of the values of
///         shaders/shade.glsl.h
/// Cost    one full-screen dispatch; 8 bytes written per pixel. With `lists_tiles`: a clear of the image, a
///         small dispatch that lists tiles, and a dispatch over these tiles
/// Source  the step of VRMC_materials_mtoon 1.0
[[nodiscard]] gpu::ImageId add_shade(gpu::Graph& graph, const ShadeInputs& in);

struct FarInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId depth;  ///< depth of visible surfaces, from Surface::depth
    glm::uvec2 size_px{0};
};

/// Lists the tiles of 8 x 8 pixels that may show sky. A listed tile may have a pixel of background, or of a
/// surface that is `from_m` or farther from the eye. No other tile has a pixel of background or of a far
/// surface. In parallel projection all tiles are listed.
///
/// Writes  a list of tiles, see shaders/tiles.glsl.h
/// Cost    one thread per tile, which stops at the first such pixel
[[nodiscard]] gpu::BufferId add_far_tiles(gpu::Graph& graph, const FarInputs& in, float from_m);

} // namespace estampe::surface
