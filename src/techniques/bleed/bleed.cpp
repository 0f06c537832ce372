// SPDX-License-Identifier: MIT
#include "techniques/bleed/bleed.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/bleed_across_comp.hpp"
#include "shaders/bleed_down_comp.hpp"
#include "techniques/bleed/bleed.glsl.h"

namespace estampe::bleed {
namespace {

constexpr float largest_radius_px = 24.0F;
constexpr float sigmas_taken_in = 2.5F;

shared::BleedConstants constants_of(const BleedInputs& in, const BleedStyle& style)
{
    const float width_px = style.width_mm * in.pixels_per_mm;
    // Under a third of a pixel a blur would do nothing, and its exponent grow without bound.
    const float sigma_px = std::clamp(0.5F * width_px, 0.3F, largest_radius_px / sigmas_taken_in);
    return {.size_px = in.size_px,
            .radius_px = static_cast<uint32_t>(std::ceil(sigmas_taken_in * sigma_px)),
            .falloff = 0.5F / (sigma_px * sigma_px),
            .level = style.level,
            // What runs less than the page's pixels can show fades out: contrast alone would blacken tones.
            .reach = std::min(0.5F * width_px, 1.0F),
            // So steep that bare paper stays bare.
            .contrast = std::max(style.contrast, 0.5F / style.level)};
}

} // namespace

gpu::ImageId add_bleed(gpu::Graph& graph, const BleedInputs& in, const BleedStyle& style)
{
    if (style.width_mm <= 0.0F) {
        return in.hatch;
    }
    const shared::BleedConstants constants = constants_of(in, style);
    const gpu::ImageDesc page{.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f};

    auto across = graph.compute("bleed/across", shaders::bleed_across_comp);
    across.sample(in.hatch).sample(in.lines);
    const gpu::ImageId smeared = across.write(graph.image("bleed/across", page));
    across.push(constants).dispatch_over(in.size_px.x, in.size_px.y);

    auto down = graph.compute("bleed/down", shaders::bleed_down_comp);
    down.sample(in.hatch).sample(in.lines).sample(smeared);
    const gpu::ImageId ink = down.write(graph.image("bleed/ink", page));
    down.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::bleed
