// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "shaders/horizon_comp.hpp"
#include "shaders/horizon_page_comp.hpp"
#include "shaders/horizon_smooth_comp.hpp"
#include "techniques/occlusion/half_page.hpp"
#include "techniques/occlusion/horizon/horizon.glsl.h"
#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {
namespace {

shared::HorizonConstants constants_of(const OcclusionInputs& in, const OcclusionStyle& style)
{
    const HalfPage half = half_page(in);
    return {.radius_m = in.radius_m,
            .reach_px = style.reach_mm * in.pixels_per_mm,
            .thickness = style.thickness,
            .strength = style.strength,
            .from_half = half.from_half,
            .half_px = half.half_px};
}

} // namespace

float radius_of(const OcclusionStyle& style, float scene_radius_m)
{
    return style.radius_m > 0.0F ? style.radius_m : 0.2F * scene_radius_m;
}

uint32_t reach_px(const OcclusionStyle& style, float pixels_per_mm)
{
    // Beside what is looked at, four neighbours of the half page.
    constexpr uint32_t smoothed_px = 8;
    return style.drawn ? static_cast<uint32_t>(std::ceil(style.reach_mm * pixels_per_mm)) + smoothed_px : 0U;
}

gpu::ImageId add_horizon(gpu::Graph& graph, const OcclusionInputs& in, const OcclusionStyle& style)
{
    const shared::HorizonConstants constants = constants_of(in, style);
    const auto half_image = [&](const char* name) {
        return graph.image(
            name,
            {.width = constants.half_px.x, .height = constants.half_px.y, .format = gpu::Format::rg32ui});
    };
    auto looking = graph.compute("occlusion", shaders::horizon_comp);
    looking.uniform(in.frame).sample(in.depth).sample(in.normal);
    gpu::ImageId open = looking.write(half_image("occlusion/half"));
    looking.push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    for (const uint32_t is_upright : {0U, 1U}) {
        auto smoothing = graph.compute(is_upright != 0 ? "occlusion/columns" : "occlusion/rows",
                                       shaders::horizon_smooth_comp);
        smoothing.uniform(in.frame).sample(in.normal).sample(open);
        open = smoothing.write(half_image("occlusion/smooth"));
        smoothing.variant(is_upright).push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    }
    auto pass = graph.compute("occlusion/page", shaders::horizon_page_comp);
    pass.uniform(in.frame).sample(in.depth).sample(in.normal).sample(open);
    const gpu::ImageId page = pass.write(graph.image(
        "occlusion/open", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return page;
}

} // namespace estampe::occlusion
