// SPDX-License-Identifier: MIT
#include "techniques/wash/wash.hpp"

#include "shaders/wash_comp.hpp"
#include "techniques/wash/wash.glsl.h"

namespace estampe::wash {

gpu::ImageId add_wash(gpu::Graph& graph, const WashInputs& in, const WashStyle& style)
{
    auto pass = graph.compute("wash", shaders::wash_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.color).sample(in.light);
    pass.sample(in.draws).sample(in.materials).sample(in.background).sample(in.screen);
    const gpu::ImageId wash = pass.write(
        graph.image("wash", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    pass.variant((style.air > 0.0F ? shared::wash_has_air : 0U) |
                 (in.has_screen ? shared::wash_has_screen : 0U) |
                 (in.has_background ? shared::wash_has_background : 0U));
    pass.push(shared::WashConstants{.tone = in.tone,
                                    .shadow_tint = style.shadow_tint,
                                    .shadow_from = style.shadow_from,
                                    .softness = style.softness,
                                    .detail = style.detail,
                                    .least = style.least,
                                    .strength = style.strength,
                                    .neutral = style.neutral,
                                    .saturation = style.saturation,
                                    .light_tint = style.light_tint,
                                    .air = style.air,
                                    .air_color = style.air_color,
                                    .air_distance_m = style.air_distance_m})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return wash;
}

} // namespace estampe::wash
