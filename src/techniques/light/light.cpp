// SPDX-License-Identifier: MIT
#include "techniques/light/light.hpp"

#include "shaders/light_comp.hpp"

namespace estampe::light {

shared::ToneConstants tone_constants(const ToneStyle& style)
{
    return {.exposure = style.exposure,
            .gamma = style.gamma,
            .contrast = style.contrast,
            .floor = style.floor,
            .ceiling = style.ceiling,
            .local_value = style.local_value,
            .occlusion = style.occlusion};
}

gpu::ImageId add_light(gpu::Graph& graph, const LightInputs& in)
{
    auto pass = graph.compute("light", shaders::light_comp);
    pass.uniform(in.frame).uniform(in.lighting).read(in.lights);
    pass.sample(in.draw)
        .sample(in.depth)
        .sample(in.normal)
        .sample(in.draws)
        .sample(in.materials)
        .sample(in.sun_map, gpu::Format::r32f)
        .uniform(in.sun_shadow)
        .sample(in.coordinate)
        .sample(in.footprint)
        .uniform(in.edge_look);
    const gpu::ImageId light = pass.write(graph.image(
        "light", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    pass.variant((in.has_shadow ? 1U : 0U) | (in.has_local_lights ? 2U : 0U) | (in.has_emissive ? 4U : 0U) |
                 (in.shadow_variant << 8U));
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return light;
}

} // namespace estampe::light
