// SPDX-License-Identifier: MIT
#include "techniques/pigment/pigment.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/pigment_gather_comp.hpp"
#include "shaders/pigment_pool_comp.hpp"
#include "shaders/pigment_rub_comp.hpp"
#include "shaders/pigment_soften_comp.hpp"
#include "shaders/pigment_spread_comp.hpp"
#include "techniques/pigment/pigment.glsl.h"

namespace estampe::pigment {
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

/// Cells over which a layer is spread by a blur.
struct Spread {
    uint32_t cell_px = 1; ///< half of a standard deviation, so that interpolation between cells does not show
    Blur blur;            ///< in cells

    Spread(float width_mm, float pixels_per_mm)
        : cell_px(static_cast<uint32_t>(std::max(0.25F * width_mm * pixels_per_mm, 1.0F))),
          blur(blur_of(width_mm * pixels_per_mm / static_cast<float>(cell_px)))
    {
    }

    /// Cells are whole only if all of their pixels are drawn, and the values of two cells are interpolated.
    [[nodiscard]] uint32_t reach_px() const { return (blur.radius + 2) * cell_px; }
};

/// Spreads the ink of strokes, or the density of paint for pigment_gathers_paint. Writes values of cells.
gpu::ImageId add_spread(gpu::Graph& graph, const PigmentInputs& in, const Spread& spread, gpu::ImageId layer,
                        uint32_t variant)
{
    const uint32_t cell_px = spread.cell_px;
    const glm::uvec2 cell_count =
        (in.from_px + in.size_px + cell_px - 1U) / cell_px - in.from_px / cell_px; // cells that are touched
    const gpu::ImageDesc cells{.width = cell_count.x, .height = cell_count.y, .format = gpu::Format::rgba16f};

    auto gather = graph.compute("pigment/gather", shaders::pigment_gather_comp);
    gather.sample(layer).variant(variant);
    gpu::ImageId values = gather.write(graph.image("pigment/cells", cells));
    gather.push(shared::PigmentGatherConstants{
        .size_px = in.size_px, .from_px = in.from_px, .cell_count = cell_count, .cell_px = cell_px});
    gather.dispatch_over(cell_count.x, cell_count.y);

    for (const glm::uvec2 axis : {glm::uvec2(1, 0), glm::uvec2(0, 1)}) {
        auto pass = graph.compute("pigment/spread", shaders::pigment_spread_comp);
        pass.sample(values);
        values = pass.write(graph.image("pigment/spread", cells));
        pass.push(shared::PigmentSpreadConstants{.cell_count = cell_count,
                                                 .axis = axis,
                                                 .radius = spread.blur.radius,
                                                 .falloff = spread.blur.falloff});
        pass.dispatch_over(cell_count.x, cell_count.y);
    }
    return values;
}

gpu::ImageDesc page_of(const PigmentInputs& in, gpu::Format format)
{
    return {.width = in.size_px.x, .height = in.size_px.y, .format = format};
}

bool is_dry(const PigmentStyle& style)
{
    return style.soft_mm > 0.0F || style.rub > 0.0F;
}

bool spreads_paint(const PigmentStyle& style)
{
    return style.pool > 0.0F || style.wet > 0.0F;
}

bool is_wet(const PigmentStyle& style)
{
    return spreads_paint(style) || style.stray_mm > 0.0F;
}

/// Returns the wash whose paint has strayed and pooled.
gpu::ImageId add_wet(gpu::Graph& graph, const PigmentInputs& in, const PigmentStyle& style, gpu::ImageId wash)
{
    const Spread spread(style.pool_mm, in.pixels_per_mm);
    const gpu::ImageId around =
        spreads_paint(style) ? add_spread(graph, in, spread, wash, shared::pigment_gathers_paint) : wash;
    auto pool = graph.compute("pigment/pool", shaders::pigment_pool_comp);
    pool.sample(wash).sample(around);
    const gpu::ImageId pooled =
        pool.write(graph.image("pigment/pooled wash", page_of(in, gpu::Format::rgba16f)));
    pool.push(shared::PigmentWetConstants{.size_px = in.size_px,
                                          .from_px = in.from_px,
                                          .pixels_per_mm = in.pixels_per_mm,
                                          .stray_mm = style.stray_mm,
                                          .pool = style.pool,
                                          .wet = style.wet,
                                          .cell_px = spread.cell_px,
                                          .seed = static_cast<uint32_t>(style.seed)});
    pool.dispatch_over_page(in.size_px.x, in.size_px.y);
    return pooled;
}

/// Returns the layers with soft edges, and with rubbed ink in the wash.
PigmentLayers add_dry(gpu::Graph& graph, const PigmentInputs& in, const PigmentStyle& style,
                      const PigmentLayers& layers)
{
    const Blur soft = blur_of(style.soft_mm * in.pixels_per_mm);
    const Spread spread(style.rub_mm, in.pixels_per_mm);
    const shared::PigmentDryConstants constants{.size_px = in.size_px,
                                                .from_px = in.from_px,
                                                .ink = in.ink,
                                                .rub = style.rub,
                                                .cell_px = spread.cell_px,
                                                .radius_px = soft.radius,
                                                .falloff = soft.falloff};

    auto soften = graph.compute("pigment/soften", shaders::pigment_soften_comp);
    soften.sample(layers.hatch).sample(layers.lines);
    const gpu::ImageId hatch =
        soften.write(graph.image("pigment/soft hatch", page_of(in, gpu::Format::r16f)));
    const gpu::ImageId lines =
        soften.write(graph.image("pigment/soft lines", page_of(in, gpu::Format::rgba16f)));
    soften.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);

    const gpu::ImageId rubbed = style.rub > 0.0F ? add_spread(graph, in, spread, layers.hatch, 0) : hatch;
    auto rub = graph.compute("pigment/rub", shaders::pigment_rub_comp);
    rub.sample(layers.wash).sample(hatch).sample(lines).sample(rubbed);
    const gpu::ImageId new_wash = rub.write(graph.image("pigment/wash", page_of(in, gpu::Format::rgba16f)));
    const gpu::ImageId new_hatch = rub.write(graph.image("pigment/hatch", page_of(in, gpu::Format::r16f)));
    const gpu::ImageId new_lines = rub.write(graph.image("pigment/lines", page_of(in, gpu::Format::rgba8)));
    rub.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return {.wash = new_wash, .hatch = new_hatch, .lines = new_lines};
}

} // namespace

bool is_on(const PigmentStyle& style)
{
    return is_dry(style) || is_wet(style);
}

uint32_t reach_px(const PigmentStyle& style, float pixels_per_mm)
{
    const uint32_t soft_px = blur_of(style.soft_mm * pixels_per_mm).radius;
    const uint32_t rub_px = style.rub > 0.0F ? Spread(style.rub_mm, pixels_per_mm).reach_px() : 0U;
    const uint32_t pool_px = spreads_paint(style) ? Spread(style.pool_mm, pixels_per_mm).reach_px() : 0U;
    return std::max(soft_px, rub_px) + pool_px +
           static_cast<uint32_t>(std::ceil(style.stray_mm * pixels_per_mm));
}

PigmentLayers add_pigment(gpu::Graph& graph, const PigmentInputs& in, const PigmentStyle& style,
                          const PigmentLayers& layers)
{
    PigmentLayers moved = layers;
    if (is_wet(style)) {
        moved.wash = add_wet(graph, in, style, moved.wash);
    }
    return is_dry(style) ? add_dry(graph, in, style, moved) : moved;
}

const style::Table<PigmentStyle>& pigment_table()
{
    static const auto table =
        style::Table<PigmentStyle>("pigment", "Pigment: dry strokes that are rubbed, wet paint that pools")
            .number(
                "soft_mm", &PigmentStyle::soft_mm, {0.0F, 2.0F}, "mm",
                "Width over which the edges of strokes and lines fade. 0 keeps edges sharp, like those of "
                "a pen; more looks softer, like chalk.")
            .number("rub", &PigmentStyle::rub, {0.0F, 1.0F}, "",
                    "Share of the ink of hatching that is rubbed over the paper, into an even grey. 0 keeps "
                    "all ink in the strokes, 1 rubs the strokes away.")
            .number("rub_mm", &PigmentStyle::rub_mm, {0.2F, 20.0F}, "mm",
                    "How far ink is rubbed: more spreads the grey further beyond the edges of hatching. Only "
                    "used when pigment.rub is above 0.")
            .number("pool", &PigmentStyle::pool, {0.0F, 2.0F}, "",
                    "How much paint gathers at the inner side of its edges, as in a wash that dries. 0 is "
                    "even, more has darker edges.")
            .number("pool_mm", &PigmentStyle::pool_mm, {0.2F, 20.0F}, "mm",
                    "Width of edges of paint that pool or run: more reaches further. Only used when "
                    "pigment.pool or pigment.wet is above 0.")
            .number("wet", &PigmentStyle::wet, {0.0F, 1.0F}, "",
                    "How far edges of paint run out softly at wet places of the paper, about a third of the "
                    "page. 0 is dry paper with crisp edges, 1 loses these edges.")
            .number("stray_mm", &PigmentStyle::stray_mm, {0.0F, 5.0F}, "mm",
                    "How far the edges of paint stray from the shapes that the paint fills. 0 keeps to the "
                    "shapes, more is a looser hand.");
    return table;
}

} // namespace estampe::pigment
