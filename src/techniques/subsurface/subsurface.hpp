// SPDX-License-Identifier: MIT
#pragma once

// Subsurface scattering: light is transmitted from a body's far side, and spreads below the body's surface.
// The light spreads on the page, or in a map that covers all surfaces. Also draws the background of thick
// clear bodies.

#include <optional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/subsurface/subsurface.glsl.h"

namespace estampe::subsurface {

/// Where subsurface light spreads: between pixels of the page, or between texels of a map that covers all
/// surfaces.
enum class Space : uint8_t { page, texture };

/// What is seen through clear bodies: the background straight behind, or where the view ray meets it after
/// Snell's law has bent the ray at the body's front and at its next back face.
enum class Refraction : uint8_t { none, thick };

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
    /// How strongly a body's own colour tints the background behind the body, if the scene file gives the
    /// body transmission.
    float behind_tint = 0.0F;
    Refraction refraction = Refraction::none;
    float ior = 1.5F;
    float refraction_mm = 120.0F;
    bool transmission = true;
    float reach_mm = 20.0F;
    Space space = Space::page;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<SubsurfaceStyle>& subsurface_table();

/// Converts the subsurface section of a style to shader parameters.
[[nodiscard]] shared::SubsurfaceParameters parameters_of(const SubsurfaceStyle& style);

/// The subsurface style for a material with transmission. `color_share` is the share of the material's
/// colours that the picture paints; at 0 the body does not tint the background.
[[nodiscard]] SubsurfaceStyle seen_through(SubsurfaceStyle style, const Material& material,
                                           float color_share);

/// Whether the style transmits light from a body's far side.
[[nodiscard]] bool shines(const SubsurfaceStyle& style);
[[nodiscard]] bool scatters(const SubsurfaceStyle& style);

/// Whether the background is visible through bodies that are drawn in the style.
[[nodiscard]] bool is_clear(const SubsurfaceStyle& style);

/// Whether lines behind a clear body are drawn: at least half of the background must be visible. Lines do not
/// fade, so a nearly opaque body hides them.
[[nodiscard]] bool shows_lines(const SubsurfaceStyle& style);

/// Whether bodies that are drawn in the style bend the view ray.
[[nodiscard]] bool refracts(const SubsurfaceStyle& style);

/// The distance in pixels from which light reaches a pixel, also from beyond the page.
[[nodiscard]] uint32_t reach_px(const SubsurfaceStyle& style, float pixels_per_mm);

/// The visible surfaces, and their subsurface parameters.
struct SubsurfaceInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::BufferId parameters; ///< SubsurfaceParameters records, one per parameter set
    /// Parameter set of each draw call; empty if there is one set.
    std::optional<gpu::BufferId> variant_of_draw;
    float reach_mm = 20.0F;
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< position of the current tile's first pixel on the page
    gpu::ExecutionProfile execution;
    /// The projection is perspective: depth alone gives the distance along the view.
    bool in_perspective = false;

    /// Offset (0 or 1) of the tile's first pixel that has an even page position, where the half page (every
    /// second pixel) begins.
    [[nodiscard]] glm::uvec2 second_from() const { return from_px & 1U; }

    [[nodiscard]] glm::uvec2 half_px() const
    {
        return glm::max((size_px + 1U - second_from()) / 2U, glm::uvec2(1));
    }
};

/// The far side of visible bodies as a surface to light, on the half page (every second pixel).
struct FarSide {
    gpu::ImageId draw;   ///< r32ui: draw call + 1, or 0 where almost no light is transmitted
    gpu::ImageId depth;  ///< r32f: reversed depth of the far side
    gpu::ImageId normal; ///< rg32ui: normal away from the eye, stored twice
    gpu::BufferId tiles; ///< list of tiles with transmitted light, see shaders/tiles.glsl.h
};

/// Adds a pass that finds where the view ray leaves each visible body. `behind` is the visibility buffer of
/// the scattering surfaces right behind the visible surfaces, at every second pixel (the half page). Cost:
/// one dispatch over the half page.
[[nodiscard]] FarSide add_far_side(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::BufferId behind,
                                   gpu::BufferId triangles, gpu::BufferId posed_vertices);

/// The far side of bodies, and the light on it.
struct Through {
    FarSide far_side;
    gpu::ImageId light;
};

/// Adds passes that spread `light`, with transmitted light from the far side, below the surface; if `spreads`
/// is false, the passes only add the transmitted light. Returns the new version of `light`. Transmission
/// follows the Beer-Lambert law.
///
/// Cost    one dispatch over the half page, then one over the squares that receive light. Spreading adds one
///         dispatch (two on a CPU) over the half page per doubling of the scattering distance on the page, up
///         to the reach
/// Source  Christensen and Burley, "Approximate Reflectance Profiles for Efficient Subsurface Scattering",
///         2015; Gaussians after d'Eon, Luebke and Enderton, "Efficient Rendering of Human Skin", 2007; on
///         the page after Jimenez, Sundstedt and Gutierrez, "Screen-Space Perceptual Rendering of Human
///         Skin", 2009; with holes after Shensa, "The Discrete Wavelet Transform: Wedding the a Trous and
///         Mallat Algorithms", 1992
[[nodiscard]] gpu::ImageId add_scatter(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::ImageId light,
                                       const std::optional<Through>& through = std::nullopt,
                                       bool spreads = true);

/// Surfaces of clear bodies per pixel: front and back of up to two bodies, one behind the other.
inline constexpr uint32_t inside_layers = 4;

struct BehindInputs {
    SubsurfaceInputs common;
    gpu::BufferId visibility; ///< visibility buffer of all solid surfaces
    /// Visibility buffers of clear bodies only, nearest first, at most `inside_layers`.
    std::vector<gpu::BufferId> inside;
    gpu::BufferId background; ///< visibility buffer of all solid surfaces except clear bodies
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::ImageId color;   ///< rgba8: colour of the visible surface, as square root of linear colour
    gpu::ImageId painted; ///< rgba16f: the painted background
    /// Places of the background that are seen through clear bodies, from add_refraction(); empty: the places
    /// straight behind.
    std::optional<gpu::ImageId> bent = std::nullopt;
};

struct RefractionInputs {
    SubsurfaceInputs common;
    /// Visibility buffers of clear bodies only, of front and back faces, nearest first; at least two.
    std::span<const gpu::BufferId> inside;
    gpu::BufferId background; ///< visibility buffer of all solid surfaces except clear bodies
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    float most_mm = 0.0F; ///< largest distance on the page between a pixel and what it shows
};

/// Adds a pass that finds, for each pixel of a clear body, the place on the page where the background shows
/// what is seen through the body. The view ray is bent where it enters the body and where it leaves the body
/// at the next back face. What the page does not show, such as things beside the page or behind other things,
/// is replaced by the last place on the ray's way.
///
/// Writes  rgba32f: place in pixels of the rendered area; 1 where lines behind the body are drawn; 1 where
/// the
///         ray is bent
/// Cost    one full-screen dispatch; per pixel of a bending body up to 140 depths and 10 triangles, and one
///         triangle more for each sample at which the ray is behind something
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.5;
///         two refractions after Wyman, "An Approximate Image-Space Approach for Interactive Refraction",
///         2005
[[nodiscard]] gpu::ImageId add_refraction(gpu::Graph& graph, const RefractionInputs& in);

/// Adds a pass that draws into `lines`, where clear bodies are visible, the image `behind` of the lines
/// behind clear bodies, read at the places `bent` of add_refraction(). Returns the new version of `lines`.
/// Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_bent_lines(gpu::Graph& graph, gpu::ImageId bent, gpu::ImageId behind,
                                          gpu::ImageId lines, glm::uvec2 size_px);

/// Adds passes that blend the background into `wash` where clear bodies are visible, and returns the new
/// version. Absorption (Beer-Lambert law) and blur are summed along the path through all bodies; then the
/// background is blurred once.
///
/// Cost    one full-screen dispatch, one per halving of the background, and one full-screen dispatch with 16
///         texel reads per pixel of a body
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.5
[[nodiscard]] gpu::ImageId add_behind(gpu::Graph& graph, const BehindInputs& in, gpu::ImageId wash);

/// A map of all surfaces, see shaders/surface_map.glsl and shaders/map_corners.glsl, with the data of its
/// surfaces.
struct TextureInputs {
    gpu::BufferId map_texels;
    gpu::BufferId map_corners;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    gpu::BufferId parameters; ///< SubsurfaceParameters records, one per parameter set
    /// Parameter set of each draw call; empty if there is one set.
    std::optional<gpu::BufferId> variant_of_draw;
    uint32_t size = 0;           ///< texels per side of the map
    float most_spread_tx = 1.0F; ///< largest scattering distance of all colours and parameter sets
};

/// The map's texels as surfaces to light. All images have the map's size.
struct TextureSurface {
    gpu::ImageId draw;   ///< r32ui: draw call + 1 and flags, as in Surface::draw; 0 for unused texels
    gpu::ImageId normal; ///< rg32ui: packed normal, stored twice
    /// Rgba32f: xyz position relative to a nearby origin, w size of the texel in the scene.
    gpu::ImageId points;
};

/// Adds a pass that finds the position and normal of each map texel on the posed surfaces. Cost: one dispatch
/// over the map.
[[nodiscard]] TextureSurface add_texture_surface(gpu::Graph& graph, const TextureInputs& in);

/// Light after it has spread between the map's texels.
struct TextureLight {
    gpu::ImageId spread; ///< rgba32f: scattering distance per colour, in texels
    gpu::ImageId sum; ///< rgba32f: light scattered from other texels; alpha is 1 where the surface scatters
};

/// Adds passes that spread `light`, which falls on the map's texels, between texels. The passes use the
/// diffusion profile of add_scatter().
///
/// Cost two dispatches per doubling of the reach in texels, and one more, over the map Source d'Eon, Luebke
/// and Enderton, "Efficient Rendering of Human Skin", 2007, and as add_scatter()
[[nodiscard]] TextureLight add_texture_scatter(gpu::Graph& graph, const TextureInputs& in,
                                               const TextureSurface& surface, gpu::ImageId light);

/// Adds the light that has spread in the map to the page's `light`. A part of `light` stays in place. Returns
/// the new version of `light`. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_texture_page(gpu::Graph& graph, const TextureInputs& in,
                                            const TextureLight& spread, gpu::BufferId frame,
                                            gpu::BufferId visibility, gpu::ImageId light, glm::uvec2 size_px);

} // namespace estampe::subsurface
