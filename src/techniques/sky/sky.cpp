// SPDX-License-Identifier: MIT
#include "techniques/sky/sky.hpp"

#include "shaders/sky_comp.hpp"
#include "techniques/sky/sky.glsl.h"

namespace estampe::sky {

Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style)
{
    const glm::uvec2 size_px = in.drawn ? in.size_px : glm::uvec2(1);
    auto pass = graph.compute("sky", shaders::sky_comp);
    pass.uniform(in.frame);
    const gpu::ImageId wash = pass.write(
        graph.image("sky/wash", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba16f}));
    const gpu::ImageId ink = pass.write(
        graph.image("sky/ink", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::r16f}));
    pass.variant(in.drawn ? 1U : 0U);
    pass.push(shared::SkyConstants{.horizon_color = style.horizon,
                                   .stroke_width_px = style.width_mm * in.pixels_per_mm,
                                   .zenith_color = style.zenith,
                                   .darkness = style.darkness,
                                   .towards_sun = in.towards_sun})
        .dispatch_over(size_px.x, size_px.y);
    return {wash, ink};
}

} // namespace estampe::sky
