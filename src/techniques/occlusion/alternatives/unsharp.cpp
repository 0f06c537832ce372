// SPDX-License-Identifier: MIT
#include "techniques/occlusion/alternatives/unsharp.hpp"

#include "shaders/unsharp_blur_comp.hpp"
#include "shaders/unsharp_page_comp.hpp"
#include "techniques/occlusion/alternatives/unsharp.glsl.h"

namespace estampe::occlusion {

AmbientOcclusion add_unsharp(gpu::Graph& graph, const OcclusionInputs& in, const OcclusionStyle& style)
{
    const HalfPage half = half_page(in);
    const shared::UnsharpConstants constants{.reach_px = style.reach_mm * in.pixels_per_mm,
                                             .radius_m = in.radius_m,
                                             .strength = style.strength,
                                             .from_half = half.from_half,
                                             .half_px = half.half_px};
    gpu::ImageId mean = in.depth;
    for (const uint32_t is_upright : {0U, 1U}) {
        auto pass = graph.compute(is_upright != 0 ? "occlusion/columns" : "occlusion/rows",
                                  shaders::unsharp_blur_comp);
        pass.uniform(in.frame).sample(in.depth).sample(mean);
        mean = pass.write(
            graph.image("occlusion/mean",
                        {.width = half.half_px.x, .height = half.half_px.y, .format = gpu::Format::r32f}));
        pass.variant(is_upright).push(constants).dispatch_over(half.half_px.x, half.half_px.y);
    }
    auto pass = graph.compute("occlusion/page", shaders::unsharp_page_comp);
    pass.uniform(in.frame).sample(in.depth).sample(mean);
    const gpu::ImageId page = pass.write(graph.image(
        "occlusion/open", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return {.visibility = page, .bounced = std::nullopt};
}

} // namespace estampe::occlusion
