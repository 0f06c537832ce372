// SPDX-License-Identifier: MIT
#pragma once

// How much of the light from everywhere reaches what is seen.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::occlusion {

/// How it is found: from the depths on the page, between all vertices, by pixels or by texels from all
/// vertices, or as a mask of depth.
enum class Method : uint8_t { horizon, discs, splats, uv, unsharp };

/// Whether there is a disc at each vertex.
[[nodiscard]] constexpr bool has_discs(Method method)
{
    return method == Method::discs || method == Method::splats || method == Method::uv;
}

/// What occlusion is let into: light from everywhere, all light, or nothing but its own mask.
enum class Feeds : uint8_t { ambient, tone, layer };

struct OcclusionStyle {
    bool drawn = false;
    Method method = Method::horizon;
    Feeds feeds = Feeds::ambient;
    float radius_m = 0.0F;
    float reach_mm = 25.0F;
    float thickness = 0.5F;
    float strength = 1.0F;
    float bleeding = 0.0F;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<OcclusionStyle>& occlusion_table();

struct OcclusionInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;
    gpu::ImageId normal;
    float radius_m = 1.0F; ///< as radius_of() has it
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
    glm::uvec2 from_px{0}; ///< where on the page what is drawn begins
};

/// What was found for pixels.
struct OpenPage {
    gpu::ImageId open;                  ///< r16f: share of the light from everywhere
    std::optional<gpu::ImageId> thrown; ///< rgba16f: what of it is thrown back by what hides
};

/// The style's radius, or what it is in a scene of this one.
[[nodiscard]] float radius_of(const OcclusionStyle& style, float scene_radius_m);

/// How far off the page the pixels may lie that one of this style hangs on.
[[nodiscard]] uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm);

/// Finds occlusion from what is seen about each pixel, and nothing else.
///
/// Writes  r16f, as large as what is drawn: the share of the light, 1 where nothing is seen
/// Cost    four dispatches, all but the last over every second pixel each way: 20 depths, twice 4 neighbours,
///         then 4 at every pixel
/// Source  Therrien, Levesque and Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023;
///         slices and their weights after Jimenez et al., "Practical Real-Time Strategies for Accurate
///         Indirect Occlusion", 2016
[[nodiscard]] gpu::ImageId add_horizon(gpu::Graph& graph, const OcclusionInputs& in,
                                       const OcclusionStyle& style);

/// Darkens what lies behind the mean of the depths about it, as a drawing does that lifts things off their
/// ground: no light is worked out.
///
/// Writes  as add_horizon() does
/// Cost    three dispatches, two over every second pixel each way: 16 depths each, then 4 at every pixel
/// Source  Luft, Colditz and Deussen, "Image Enhancement by Unsharp Masking the Depth Buffer", SIGGRAPH 2006
[[nodiscard]] gpu::ImageId add_unsharp(gpu::Graph& graph, const OcclusionInputs& in,
                                       const OcclusionStyle& style);

/// Pixel `i` is pixel 2 * (from_half + i) of the page: the same pixels of it whatever tile is drawn.
struct HalfPage {
    glm::uvec2 from_half{0};
    glm::uvec2 half_px{1};
};

[[nodiscard]] inline HalfPage half_page(const OcclusionInputs& in)
{
    const glm::uvec2 from_half = (in.from_px + 1U) / 2U;
    const glm::uvec2 last_half = (in.from_px + in.size_px - 1U) / 2U;
    return {.from_half = from_half, .half_px = glm::max(last_half + 1U, from_half + 1U) - from_half};
}

} // namespace estampe::occlusion
