// SPDX-License-Identifier: MIT
#include "techniques/hatch/hatch.hpp"

#include <glm/trigonometric.hpp>

#include "shaders/hatch_comp.hpp"
#include "techniques/hatch/hatch.glsl.h"

namespace estampe::hatch {
namespace {

/// The direction across strokes that run along u, turned by `degrees`.
glm::vec2 turned(float degrees)
{
    return {-glm::sin(glm::radians(degrees)), glm::cos(glm::radians(degrees))};
}

} // namespace

gpu::ImageId add_hatch(gpu::Graph& graph, const HatchInputs& in, const HatchStyle& style)
{
    auto pass = graph.compute("hatch", shaders::hatch_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.normal).sample(in.color);
    pass.sample(in.coordinate).sample(in.footprint).sample(in.light).sample(in.screen);
    const gpu::ImageId ink = pass.write(graph.image(
        "hatch/ink", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.variant((style.fade < 1.0F ? 1U : 0U) | (in.has_screen ? 2U : 0U));
    pass.push(shared::HatchConstants{.tone = in.tone,
                                     .width_px = style.width_mm * in.pixels_per_mm,
                                     .wobble_px = style.wobble_mm * in.pixels_per_mm,
                                     .gap_px = style.gap_mm * in.pixels_per_mm,
                                     .taper_px = style.taper_mm * in.pixels_per_mm,
                                     .cell_px = style.length_mm * in.pixels_per_mm,
                                     .pressure = style.pressure,
                                     .fade = style.fade,
                                     .fade_distance_m = style.fade_distance_m,
                                     .layers = style.drawn ? static_cast<uint32_t>(style.layers) : 0U,
                                     .seed = static_cast<uint32_t>(style.seed),
                                     .uv_axis_0 = turned(style.slant_deg),
                                     .uv_axis_1 = turned(style.slant_deg + 62.0F),
                                     .uv_axis_2 = turned(style.slant_deg - 41.0F),
                                     .black_above = style.drawn ? style.black_above : 2.0F})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::hatch
