// SPDX-License-Identifier: MIT
#pragma once

// Light that goes into what is seen: it comes through from behind, and out again beside where it went in.

#include <optional>

#include <estampe/scene.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/subsurface/subsurface.glsl.h"
#include "techniques/subsurface/subsurface_style.hpp"

namespace estampe::subsurface {

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
    gpu::BufferId tiles; ///< in which light does, see shaders/tile_list.glsl.h
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

} // namespace estampe::subsurface
