// SPDX-License-Identifier: MIT
#include "techniques/bleed/bleed.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/bleed_across_comp.hpp"
#include "shaders/bleed_down_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/bleed/bleed.glsl.h"

namespace estampe::bleed {
namespace {

constexpr float largest_radius_px = 96.0F; // about the blur's radius for a bleed 3 mm wide, at 600 dpi
constexpr float sigmas_taken_in = 2.5F;

float sigma_px(const BleedStyle& style, float pixels_per_mm)
{
    // Standard deviation of the blur in pixels. Below a third of a pixel a blur has no effect, and the
    // exponent of the blur's Gaussian grows without bound.
    return std::clamp(0.5F * style.width_mm * pixels_per_mm, 0.3F, largest_radius_px / sigmas_taken_in);
}

shared::BleedConstants constants_of(const BleedInputs& in, const BleedStyle& style)
{
    const float width_px = style.width_mm * in.pixels_per_mm;
    const float sigma = sigma_px(style, in.pixels_per_mm);
    return {.size_px = in.size_px,
            .radius_px = reach_px(style, in.pixels_per_mm),
            .falloff = 0.5F / (sigma * sigma),
            .level = style.level,
            // If ink bleeds less far than a pixel, bleed fades out, because contrast alone would blacken
            // tones.
            .reach = std::min(0.5F * width_px, 1.0F),
            // The contrast is at least so steep that bare paper stays bare.
            .contrast = std::max(style.contrast, 0.5F / style.level)};
}

} // namespace

uint32_t reach_px(const BleedStyle& style, float pixels_per_mm)
{
    const float radius_px = std::ceil(sigmas_taken_in * sigma_px(style, pixels_per_mm));
    return style.enabled ? static_cast<uint32_t>(radius_px) : 0U;
}

gpu::ImageId add_bleed(gpu::Graph& graph, const BleedInputs& in, const BleedStyle& style)
{
    if (!style.enabled) {
        return in.hatch;
    }
    const shared::BleedConstants constants = constants_of(in, style);
    const gpu::ImageDesc page{.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f};

    auto across = graph.compute("bleed/across", shaders::bleed_across_comp);
    across.sample(in.hatch).sample(in.lines);
    const gpu::ImageId smeared = across.write(graph.image("bleed/across", page));
    across.variant(in.strokes_run ? 0U : shared::bleed_only_lines);
    across.push(constants).dispatch_over(in.size_px.x, in.size_px.y);

    auto down = graph.compute("bleed/down", shaders::bleed_down_comp);
    down.sample(in.hatch).sample(in.lines).sample(smeared);
    const gpu::ImageId ink = down.write(graph.image("bleed/ink", page));
    down.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

const style::Table<BleedStyle>& bleed_table()
{
    static const auto table =
        style::Table<BleedStyle>("bleed", "Ink bleed: ink that runs into corners and narrow gaps")
            .toggle("enabled", &BleedStyle::enabled,
                    "Turns ink bleed on: ink runs into corners and narrow gaps")
            .number("width_mm", &BleedStyle::width_mm, {0.02F, 3.0F}, "mm",
                    "How far ink runs on the page: more fills corners further. Gaps between two areas of "
                    "solid black close if they are narrower than three quarters of this width.")
            .number("contrast", &BleedStyle::contrast, {1.0F, 20.0F}, "",
                    "Sharpness of the edge of ink that has run: less is soft, more is crisp")
            .number("level", &BleedStyle::level, {0.1F, 0.9F}, "",
                    "How much ink must surround a spot of paper, as a share, before the spot turns to ink. "
                    "Less lets ink run further. Below 0.5, straight edges grow a little.");
    return table;
}

} // namespace estampe::bleed
