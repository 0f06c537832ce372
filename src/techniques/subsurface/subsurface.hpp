// SPDX-License-Identifier: MIT
#pragma once

// Light that goes into what is seen: it comes through from behind, and out again beside where it went in, on
// the page or in a map that lies on all surfaces. What lies behind thick see-through bodies.

#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/subsurface/subsurface.glsl.h"

namespace estampe::subsurface {

/// Where light spreads: between pixels of the page, or between texels of a map that lies on all surfaces.
enum class Space : uint8_t { page, texture };

struct SubsurfaceStyle {
    bool enabled = false;
    float scatter_m = 0.004F;
    glm::vec3 scatter_color = style::srgb(0xffa58a);
    float depth_m = 0.02F;
    glm::vec3 tint = style::srgb(0xd95a3a);
    float strength = 1.0F;
    float sheet_m = 0.0F;
    float behind = 0.0F;
    float behind_blur = 0.5F;
    float behind_tint = 0.0F; ///< by the surface's own colour, of what a file says is seen through
    bool transmission = true;
    float reach_mm = 20.0F;
    Space space = Space::page;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<SubsurfaceStyle>& subsurface_table();

/// What the shaders know of a style.
[[nodiscard]] shared::SubsurfaceLook look_of(const SubsurfaceStyle& style);

/// A style with what a material says of what is seen through it; `color_share` is how much of its colours is
/// painted, else they tint nothing.
[[nodiscard]] SubsurfaceStyle seen_through(SubsurfaceStyle style, const Material& material,
                                           float color_share);

/// Whether light comes through, or spreads.
[[nodiscard]] bool shines(const SubsurfaceStyle& style);
[[nodiscard]] bool scatters(const SubsurfaceStyle& style);

/// Whether what lies behind is seen.
[[nodiscard]] bool is_clear(const SubsurfaceStyle& style);

/// Whether lines behind it are drawn: it is clear, and at least half of what lies behind is seen. Lines do
/// not pale, so that what is nearly solid hides them.
[[nodiscard]] bool shows_lines(const SubsurfaceStyle& style);

/// How far off the page the pixels may lie that one of this style hangs on.
[[nodiscard]] uint32_t reach_px(const SubsurfaceStyle& style, float pixels_per_mm);

/// What is seen, and which of it takes light in.
struct SubsurfaceInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::BufferId looks;                       ///< SubsurfaceLook
    std::optional<gpu::BufferId> look_of_draw; ///< where there are several
    float reach_mm = 20.0F;
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< where on the page what is drawn begins
    gpu::ExecutionProfile execution;
    bool in_perspective = false; ///< then depth alone tells how far along the view something lies

    /// Every second pixel each way, of those at even places of the page: which is the first, and how many.
    [[nodiscard]] glm::uvec2 second_from() const { return from_px & 1U; }

    [[nodiscard]] glm::uvec2 half_px() const
    {
        return glm::max((size_px + 1U - second_from()) / 2U, glm::uvec2(1));
    }
};

/// The far side of what is seen, for light to fall on: a surface as that of the near side, of every second
/// pixel each way.
struct FarSide {
    gpu::ImageId draw;   ///< r32ui: draw + 1, 0 where next to no light comes through
    gpu::ImageId depth;  ///< r32f: reversed
    gpu::ImageId normal; ///< rg32ui: away from the eye, twice
    gpu::BufferId tiles; ///< in which light does, see shaders/tiles.glsl.h
};

/// Finds where the eye's ray leaves what it entered. `behind` is the visibility of what takes light in and
/// lies behind what is seen, of every second pixel each way. Cost: one dispatch over these.
[[nodiscard]] FarSide add_far_side(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::BufferId behind,
                                   gpu::BufferId triangles, gpu::BufferId posed_vertices);

/// Light that falls on the far side.
struct Through {
    FarSide far_side;
    gpu::ImageId light;
};

/// Lets `light`, with what comes through from the far side, spread under the surface; or, if it does not
/// spread, adds the one to the other. Returns the new version of `light`. What comes through follows Beer and
/// Lambert's law.
///
/// Cost    one dispatch over every second pixel each way, then one over the squares that get any of it. Where
///         it spreads one, two on a processor, for each doubling of how far it does on the page, as far as
///         its reach, over every second pixel
/// Source  Christensen and Burley, "Approximate Reflectance Profiles for Efficient Subsurface Scattering",
///         2015; Gaussians after d'Eon, Luebke and Enderton, "Efficient Rendering of Human Skin", 2007; on
///         the page after Jimenez, Sundstedt and Gutierrez, "Screen-Space Perceptual Rendering of Human
///         Skin", 2009; with holes after Shensa, "The Discrete Wavelet Transform: Wedding the a Trous and
///         Mallat Algorithms", 1992
[[nodiscard]] gpu::ImageId add_scatter(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::ImageId light,
                                       const std::optional<Through>& through = std::nullopt,
                                       bool spreads = true);

inline constexpr uint32_t inside_layers =
    4; ///< surfaces of bodies that count: two bodies, one behind another

struct BehindInputs {
    SubsurfaceInputs common;
    gpu::BufferId visibility;          ///< of all that is solid
    std::vector<gpu::BufferId> inside; ///< of clear bodies alone, `inside_layers` at most, the nearest first
    gpu::BufferId background;          ///< visibility of all that is solid but them
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::ImageId color;   ///< rgba8: of what is seen, square root of linear
    gpu::ImageId painted; ///< rgba16f: paint of the background
};

/// Lays what lies behind into `wash`, where clear bodies are seen, and returns its new version. The way
/// through all bodies is summed up, colour by the law of Beer and Lambert and blur by thickness; then the
/// background is blurred once, by that sum.
///
/// Cost    a dispatch over all, one for each halving of the background, and one over all that reads 16 texels
///         a pixel of a body
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.5
[[nodiscard]] gpu::ImageId add_behind(gpu::Graph& graph, const BehindInputs& in, gpu::ImageId wash);

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
