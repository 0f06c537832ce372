// SPDX-License-Identifier: MIT
#include "techniques/smudge/smudge.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/smudge_gather_comp.hpp"
#include "shaders/smudge_rub_comp.hpp"
#include "shaders/smudge_soften_comp.hpp"
#include "shaders/smudge_spread_comp.hpp"
#include "techniques/smudge/smudge.glsl.h"

namespace estampe::smudge {
namespace {

constexpr float sigmas_taken_in = 2.5F;

/// A blur by a Gaussian that is cut off.
struct Blur {
    uint32_t radius = 0;
    float falloff = 0.0F; ///< 1 / (2 sigma^2)
};

/// A blur with a standard deviation of half of `width`. Below a third of a pixel a blur has no effect, and
/// its exponent grows without bound.
Blur blur_of(float width)
{
    const float sigma = 0.5F * width;
    if (sigma < 0.3F) {
        return {};
    }
    return {static_cast<uint32_t>(std::ceil(sigmas_taken_in * sigma)), 0.5F / (sigma * sigma)};
}

/// Side of the cells over which ink is spread: half of a standard deviation, so that interpolation between
/// cells does not show.
uint32_t cell_px_of(const SmudgeStyle& style, float pixels_per_mm)
{
    return static_cast<uint32_t>(std::max(0.25F * style.width_mm * pixels_per_mm, 1.0F));
}

/// Spreads the strokes' ink over the paper. Writes the mean ink of cells, for smudge_rub.comp.
gpu::ImageId add_spread(gpu::Graph& graph, const SmudgeInputs& in, const SmudgeStyle& style,
                        gpu::ImageId hatch)
{
    const uint32_t cell_px = cell_px_of(style, in.pixels_per_mm);
    const glm::uvec2 cell_count =
        (in.from_px + in.size_px + cell_px - 1U) / cell_px - in.from_px / cell_px; // cells that are touched
    const gpu::ImageDesc cells{.width = cell_count.x, .height = cell_count.y, .format = gpu::Format::r16f};

    auto gather = graph.compute("smudge/gather", shaders::smudge_gather_comp);
    gather.sample(hatch);
    gpu::ImageId ink = gather.write(graph.image("smudge/cells", cells));
    gather.push(shared::SmudgeGatherConstants{
        .size_px = in.size_px, .from_px = in.from_px, .cell_count = cell_count, .cell_px = cell_px});
    gather.dispatch_over(cell_count.x, cell_count.y);

    const Blur blur = blur_of(style.width_mm * in.pixels_per_mm / static_cast<float>(cell_px));
    for (const glm::uvec2 axis : {glm::uvec2(1, 0), glm::uvec2(0, 1)}) {
        auto spread = graph.compute("smudge/spread", shaders::smudge_spread_comp);
        spread.sample(ink);
        ink = spread.write(graph.image("smudge/spread", cells));
        spread.push(shared::SmudgeSpreadConstants{
            .cell_count = cell_count, .axis = axis, .radius = blur.radius, .falloff = blur.falloff});
        spread.dispatch_over(cell_count.x, cell_count.y);
    }
    return ink;
}

} // namespace

bool is_on(const SmudgeStyle& style)
{
    return style.soft_mm > 0.0F || style.strength > 0.0F;
}

uint32_t reach_px(const SmudgeStyle& style, float pixels_per_mm)
{
    const uint32_t soft_px = blur_of(style.soft_mm * pixels_per_mm).radius;
    if (style.strength <= 0.0F) {
        return soft_px;
    }
    // Cells are whole only if all of their pixels are drawn, and the values of two cells are interpolated.
    const uint32_t cell_px = cell_px_of(style, pixels_per_mm);
    const Blur blur = blur_of(style.width_mm * pixels_per_mm / static_cast<float>(cell_px));
    return std::max(soft_px, (blur.radius + 2) * cell_px);
}

SmudgeLayers add_smudge(gpu::Graph& graph, const SmudgeInputs& in, const SmudgeStyle& style,
                        const SmudgeLayers& layers)
{
    if (!is_on(style)) {
        return layers;
    }
    const auto page = [&](gpu::Format format) {
        return gpu::ImageDesc{.width = in.size_px.x, .height = in.size_px.y, .format = format};
    };
    const Blur soft = blur_of(style.soft_mm * in.pixels_per_mm);
    const shared::SmudgeConstants constants{.size_px = in.size_px,
                                            .from_px = in.from_px,
                                            .ink = in.ink,
                                            .strength = style.strength,
                                            .cell_px = cell_px_of(style, in.pixels_per_mm),
                                            .radius_px = soft.radius,
                                            .falloff = soft.falloff};

    auto soften = graph.compute("smudge/soften", shaders::smudge_soften_comp);
    soften.sample(layers.hatch).sample(layers.lines);
    const gpu::ImageId hatch = soften.write(graph.image("smudge/soft hatch", page(gpu::Format::r16f)));
    const gpu::ImageId lines = soften.write(graph.image("smudge/soft lines", page(gpu::Format::rgba16f)));
    soften.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);

    const gpu::ImageId spread =
        style.strength > 0.0F ? add_spread(graph, in, style, layers.hatch) : layers.hatch;
    auto rub = graph.compute("smudge/rub", shaders::smudge_rub_comp);
    rub.sample(layers.wash).sample(hatch).sample(lines).sample(spread);
    const gpu::ImageId smudged_wash = rub.write(graph.image("smudge/wash", page(gpu::Format::rgba16f)));
    const gpu::ImageId smudged_hatch = rub.write(graph.image("smudge/hatch", page(gpu::Format::r16f)));
    const gpu::ImageId smudged_lines = rub.write(graph.image("smudge/lines", page(gpu::Format::rgba8)));
    rub.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return {.wash = smudged_wash, .hatch = smudged_hatch, .lines = smudged_lines};
}

const style::Table<SmudgeStyle>& smudge_table()
{
    static const auto table =
        style::Table<SmudgeStyle>("smudge",
                                  "Smudge: soft edges and rubbed tone of pencil, chalk and charcoal")
            .number(
                "soft_mm", &SmudgeStyle::soft_mm, {0.0F, 2.0F}, "mm",
                "Width over which the edges of strokes and lines fade. 0 keeps edges sharp, like those of "
                "a pen; more looks softer, like chalk.")
            .number("strength", &SmudgeStyle::strength, {0.0F, 1.0F}, "",
                    "Share of the ink of hatching that is rubbed over the paper, into an even grey. 0 keeps "
                    "all ink in the strokes, 1 rubs the strokes away.")
            .number("width_mm", &SmudgeStyle::width_mm, {0.2F, 20.0F}, "mm",
                    "How far ink is rubbed: more spreads the grey further beyond the edges of hatching. Only "
                    "used when smudge.strength is above 0.");
    return table;
}

} // namespace estampe::smudge
