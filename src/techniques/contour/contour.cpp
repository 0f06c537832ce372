// SPDX-License-Identifier: MIT
#include "techniques/contour/contour.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/fills.hpp"
#include "shaders/edges_comp.hpp"
#include "shaders/flood_comp.hpp"
#include "shaders/seeds_comp.hpp"
#include "shaders/stroke_comp.hpp"
#include "techniques/contour/contour.glsl.h"

namespace estampe::contour {
namespace {

constexpr float most_swelling = 2.2F; // pressure, shade and nearness together widen a line by no more

constexpr uint32_t listing_groups = 128; // workgroups that share a list of unknown length

struct Seeds {
    gpu::ImageId seed;
    gpu::ImageId nearest;
};

Seeds add_seeds(gpu::Graph& graph, const ContourInputs& in, const ContourStyle& style)
{
    const uint32_t capacity = in.size_px.x * in.size_px.y;
    const gpu::BufferId none = gpu::add_zeros(graph, "contour/count", 16);

    auto detect = graph.compute("contour/edges", shaders::edges_comp);
    detect.uniform(in.frame).sample(in.draws).sample(in.draw).sample(in.depth).sample(in.normal);
    detect.sample(in.screen_draw)
        .variant((in.has_screen ? shared::edges_has_screen : 0U) |
                 (in.only_cut ? shared::edges_only_cut : 0U));
    const gpu::BufferId count = detect.modify(none);
    const gpu::BufferId edges =
        detect.write(graph.buffer("contour/edges", {.size_bytes = capacity * sizeof(shared::EdgePixel)}));
    const gpu::ImageId nearest = detect.write(graph.image(
        "contour/nearest", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32ui}));
    const float on = style.drawn ? in.pixels_per_mm : 0.0F;
    detect
        .push(shared::EdgeConstants{.outline_px = style.outline_mm * on,
                                    .boundary_px = style.boundary_mm * on,
                                    .crease_px = style.crease_mm * on,
                                    .crease_cosine = std::cos(glm::radians(style.crease_deg)),
                                    .depth_step = 12.0F * style.depth_step * in.pixel_m_at_one,
                                    .capacity = capacity})
        .dispatch_over(in.size_px.x, in.size_px.y);

    auto place = graph.compute("contour/seeds", shaders::seeds_comp);
    place.uniform(in.frame).read(in.visibility).sample(in.triangles).sample(in.posed_vertices);
    place.sample(in.depth).sample(in.coordinate).sample(in.light).read(count).read(edges);
    place.sample(in.draw)
        .sample(in.draws)
        .sample(in.materials)
        .variant(in.own_outlines ? shared::seeds_has_own_outlines : 0U);
    const gpu::ImageId seed = place.write(graph.image(
        "contour/seed", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    place
        .push(shared::SeedConstants{.pressure = style.pressure,
                                    .distance_thinning = style.distance_thinning,
                                    .pixel_m_at_one = in.pixel_m_at_one,
                                    .capacity = capacity})
        .dispatch(std::min(capacity / 64 + 1, listing_groups));
    return {seed, nearest};
}

gpu::ImageId add_flood(gpu::Graph& graph, gpu::ImageId nearest, glm::uvec2 size_px, uint32_t step_px)
{
    auto pass = graph.compute("contour/flood", shaders::flood_comp);
    pass.sample(nearest);
    const gpu::ImageId flooded = pass.write(graph.image("contour/nearest", graph.describe(nearest)));
    pass.push(shared::FloodConstants{.width = size_px.x, .height = size_px.y, .step_px = step_px})
        .dispatch_over(size_px.x, size_px.y);
    return flooded;
}

/// Half of the widest line, and a pixel.
float half_widest_px(const ContourStyle& style, float pixels_per_mm)
{
    const float widest_mm = std::max({style.outline_mm, style.boundary_mm, style.crease_mm});
    return 0.5F * widest_mm * pixels_per_mm * most_swelling + 1.0F;
}

/// Of the flood. Steps s, s/2, ..., 1 carry a seed 2s - 1 pixels far.
uint32_t first_step_px(float reach)
{
    return std::bit_ceil((static_cast<uint32_t>(std::ceil(reach)) + 2) / 2);
}

} // namespace

uint32_t reach_px(const ContourStyle& style, float pixels_per_mm)
{
    return style.drawn ? 2 * first_step_px(half_widest_px(style, pixels_per_mm)) : 0;
}

gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in, const ContourStyle& style)
{
    Seeds seeds = add_seeds(graph, in, style);
    const float reach = half_widest_px(style, in.pixels_per_mm);
    for (uint32_t step = first_step_px(reach); step > 0; step /= 2) {
        seeds.nearest = add_flood(graph, seeds.nearest, in.size_px, step);
    }
    auto pass = graph.compute("contour/stroke", shaders::stroke_comp);
    pass.sample(seeds.nearest).sample(seeds.seed).sample(in.draw).sample(in.draws).sample(in.materials);
    pass.variant(in.own_outlines ? shared::stroke_has_own_outlines : 0U);
    const gpu::ImageId ink = pass.write(graph.image(
        "contour/ink", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba8}));
    pass.push(shared::StrokeConstants{
                  .width = in.size_px.x, .height = in.size_px.y, .reach_px = reach, .ink_color = style.ink})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::contour
