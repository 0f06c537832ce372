// SPDX-License-Identifier: MIT
#include "techniques/paper/paper.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gpu/resources.hpp"
#include "shaders/compose_comp.hpp"
#include "shaders/cover_comp.hpp"
#include "shaders/develop_comp.hpp"
#include "style/parameter.hpp"

namespace estampe::paper {

Window window_of(const PaperStyle& style, float width_mm)
{
    const glm::vec2 page_mm(width_mm, style.height_mm);
    const float margin_mm = std::min(style.margin_mm, std::min(page_mm.x, page_mm.y) / 3.0F);
    return {glm::vec2(margin_mm), page_mm - margin_mm};
}

glm::ivec2 paint_shift_px(const PaperStyle& style, float pixels_per_mm)
{
    const float angle = glm::radians(style.misprint_deg);
    return glm::ivec2(
        glm::round(style.misprint_mm * pixels_per_mm * glm::vec2(std::cos(angle), std::sin(angle))));
}

uint32_t reach_px(const PaperStyle& style, float pixels_per_mm)
{
    const glm::ivec2 shift_px = glm::abs(paint_shift_px(style, pixels_per_mm));
    return static_cast<uint32_t>(std::max(shift_px.x, shift_px.y));
}

namespace {

/// Outputs of the compose pass. Only the output that is used has the page's size; the others are
/// placeholders.
struct Composed {
    gpu::ImageId picture;
    gpu::ImageId stage;
    gpu::BufferId pixels;
};

/// The output that is wanted from the compose pass. If neither `stage` nor `pixels` is set, the output is a
/// picture for add_develop().
struct Wanted {
    std::optional<Stage> stage = {};
    std::optional<gpu::BufferId> pixels = {};

    [[nodiscard]] uint32_t variant() const
    {
        return (stage ? shared::compose_is_staged : 0U) | (pixels ? shared::compose_develops : 0U);
    }
};

uint32_t compose_variant(const ComposeInputs& in, const PaperStyle& style)
{
    return (style.ink_tint > 0.0F ? shared::compose_has_tint : 0U) |
           (in.has_sky ? shared::compose_has_sky : 0U) | (in.ink ? shared::compose_has_ink : 0U) |
           (in.smoke_paint && in.smoke_ink ? shared::compose_has_smoke : 0U) |
           (style.margin_mm > 0.0F || style.border_mm > 0.0F ? shared::compose_has_margin : 0U) |
           (style.ink_grain > 0.0F ? shared::compose_has_grain : 0U) |
           (style.transparent != Transparency::none ? shared::compose_is_transparent : 0U) |
           (style.transparent == Transparency::background ? shared::compose_keeps_things : 0U) |
           (in.cover ? shared::compose_has_cover : 0U) |
           (style.misprint_mm > 0.0F ? shared::compose_is_shifted : 0U);
}

Composed compose(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style, const Wanted& wanted)
{
    auto pass = graph.compute("compose", shaders::compose_comp);
    pass.uniform(in.frame).sample(in.wash).sample(in.hatch).sample(in.lines).sample(in.sky_ink);
    // If the light image is not needed, the wash is bound in its place, so that the light's memory can be
    // reused.
    pass.sample(style.ink_tint > 0.0F ? in.light : in.wash);
    pass.sample(in.ink.value_or(in.wash));
    pass.sample(in.smoke_paint.value_or(in.wash)).sample(in.smoke_ink.value_or(in.wash));
    pass.sample(in.cover.value_or(in.wash));
    pass.variant(compose_variant(in, style) | wanted.variant());
    const auto write = [&](const char* name, gpu::Format format, bool is_wanted) {
        return pass.write(graph.image(name, {.width = is_wanted ? in.size_px.x : 1,
                                             .height = is_wanted ? in.size_px.y : 1,
                                             .format = format}));
    };
    const gpu::ImageId picture = write("picture", gpu::Format::rgba16f, !wanted.stage && !wanted.pixels);
    const gpu::ImageId staged = write("stage", gpu::Format::rgba32f, wanted.stage.has_value());
    const gpu::BufferId pixels =
        pass.write(wanted.pixels.value_or(graph.buffer("no pixels", {.size_bytes = sizeof(uint32_t)})));
    const float pixels_per_mm = static_cast<float>(in.page_px.y) / style.height_mm;
    const Window window = window_of(style, style.height_mm * static_cast<float>(in.page_px.x) /
                                               static_cast<float>(in.page_px.y));
    pass.push(shared::PaperConstants{.paper_color = style.color,
                                     .grain = style.grain,
                                     .ink_color = style.ink,
                                     .granulation = style.granulation,
                                     .ink_break = style.ink_break,
                                     .ink_tint = style.ink_tint,
                                     .seed = static_cast<uint32_t>(style.seed),
                                     .ink_grain = style.ink_grain,
                                     .border_mm = style.border_mm,
                                     .window_min_mm = window.min_mm,
                                     .window_max_mm = window.max_mm,
                                     .stage = static_cast<uint32_t>(wanted.stage.value_or(Stage::smoke)),
                                     .overprint = style.overprint,
                                     .paint_shift_px = paint_shift_px(style, pixels_per_mm),
                                     .settles = in.ink_settles})
        .dispatch((in.size_px.x + 31) / 32, (in.size_px.y + 7) / 8);
    return {picture, staged, pixels};
}

} // namespace

gpu::ImageId add_compose(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style)
{
    if (style.transparent != Transparency::none) {
        // A picture with alpha uses 32-bit floats. Half floats are too coarse for an alpha near 1: too much
        // paper would show under dark ink.
        return compose(graph, in, style, {.stage = Stage::picture}).stage;
    }
    return compose(graph, in, style, {}).picture;
}

gpu::BufferId add_pixels(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style,
                         gpu::BufferId pixels)
{
    return compose(graph, in, style, {.pixels = pixels}).pixels;
}

gpu::ImageId add_compose_stage(gpu::Graph& graph, const ComposeInputs& in, const PaperStyle& style,
                               Stage stage)
{
    return compose(graph, in, style, {.stage = stage}).stage;
}

gpu::ImageId import_sums(gpu::Graph& graph, gpu::Image& sums, const Accumulation& accumulation)
{
    return graph.import_image("sums", sums, sums.desc(),
                              accumulation.sample_index == 0 ? gpu::Layout::undefined : gpu::Layout::general);
}

Developed add_develop(gpu::Graph& graph, gpu::ImageId picture, gpu::ImageId sums, gpu::BufferId pixels,
                      glm::uvec2 size_px, const Accumulation& accumulation, PixelForm form,
                      const std::optional<glm::vec3>& transparent)
{
    auto pass = graph.compute("develop", shaders::develop_comp);
    pass.sample(picture);
    const gpu::ImageId added = pass.modify(sums);
    const gpu::BufferId written = pass.write(pixels);
    const bool is_last = accumulation.sample_index + 1 == accumulation.sample_count;
    pass.variant((accumulation.sample_count > 1 ? shared::develop_has_samples : 0U) |
                 (is_last ? shared::develop_is_last : 0U) |
                 (form == PixelForm::linear_floats ? shared::develop_keeps_floats : 0U) |
                 (transparent ? shared::develop_is_transparent : 0U));
    pass.push(shared::DevelopConstants{.width = size_px.x,
                                       .height = size_px.y,
                                       .sample_index = accumulation.sample_index,
                                       .paper_color = transparent.value_or(glm::vec3(1.0F))})
        .dispatch_over_page(size_px.x, size_px.y);
    return {added, written};
}

CoverLayers add_cover(gpu::Graph& graph, const CoverLayers& drawn, glm::uvec2 size_px)
{
    auto pass = graph.compute("cover", shaders::cover_comp);
    pass.sample(drawn.wash).sample(drawn.hatch).sample(drawn.lines);
    const auto write = [&](const char* name, gpu::Format format) {
        return pass.write(graph.image(name, {.width = size_px.x, .height = size_px.y, .format = format}));
    };
    const gpu::ImageId wash = write("cover/wash", gpu::Format::rgba16f);
    const gpu::ImageId hatch = write("cover/hatch", gpu::Format::r16f);
    const gpu::ImageId lines = write("cover/lines", gpu::Format::rgba8);
    pass.dispatch_over_page(size_px.x, size_px.y);
    return {.wash = wash, .hatch = hatch, .lines = lines};
}

const style::Table<PaperStyle>& paper_table()
{
    static const auto table =
        style::Table<PaperStyle>("paper", "Paper: the page, and how ink and paint look on the page")
            .number("height_mm", &PaperStyle::height_mm, {10.0F, 5000.0F}, "mm",
                    "Height of the page: all widths in millimetres are measured on a page of this height. "
                    "Less makes pens and strokes look larger.")
            .number("margin_mm", &PaperStyle::margin_mm, {0.0F, 1000.0F}, "mm",
                    "Width of the blank margin around the drawing, at most a third of the page's shorter "
                    "side. More makes the drawing smaller.")
            .number("border_mm", &PaperStyle::border_mm, {0.0F, 5.0F}, "mm",
                    "Width of the border line around the drawing, at the edge of the margin: more is bolder. "
                    "0 draws no line.")
            .color("color", &PaperStyle::color,
                   "Colour of the paper, such as white, cream, or a tinted sheet")
            .choice("transparent", &PaperStyle::transparent,
                    {{"none", Transparency::none},
                     {"background", Transparency::background},
                     {"paper", Transparency::paper}},
                    "Which parts of the paper are transparent, so that the picture has an alpha channel. "
                    "none: no part; background: the paper beyond all objects; paper: all bare paper, so that "
                    "only ink and paint remain.")
            .number("grain", &PaperStyle::grain, {0.0F, 1.0F}, "",
                    "Visible relief of the paper: 0 is smooth, 1 is rough")
            .number("granulation", &PaperStyle::granulation, {0.0F, 1.0F}, "",
                    "How much paint settles in the hollows of the paper: 0 is even, 1 shows the grain")
            .color("ink", &PaperStyle::ink, "Colour of the ink of hatching strokes")
            .number("ink_break", &PaperStyle::ink_break, {0.0F, 1.0F}, "",
                    "How much ink breaks up on rough paper by skipping the high spots of the paper. 0 covers "
                    "evenly, 1 looks like a dry pen.")
            .number("ink_grain", &PaperStyle::ink_grain, {0.0F, 1.0F}, "",
                    "How much strokes and lines touch only the raised grain of the paper, as graphite and "
                    "chalk do. 0 is liquid ink, 1 is dry chalk.")
            .number("ink_tint", &PaperStyle::ink_tint, {0.0F, 1.0F}, "",
                    "How much coloured light changes the colour of the ink of hatching strokes. 0 keeps the "
                    "colour of the ink, 1 changes it most.")
            .number("overprint", &PaperStyle::overprint, {0.0F, 1.0F}, "",
                    "How much paint shows through the ink of strokes and lines, as in prints with "
                    "transparent inks. 0 covers the paint, 1 mixes both colours.")
            .number(
                "misprint_mm", &PaperStyle::misprint_mm, {0.0F, 20.0F}, "mm",
                "How far paint is printed beside the ink, as in a press whose plates are out of register. "
                "0 prints paint at its place.")
            .number("misprint_deg", &PaperStyle::misprint_deg, {-180.0F, 180.0F}, "deg",
                    "Direction in which paint is printed beside the ink: 0 is to the right, 90 is down. Only "
                    "used when paper.misprint_mm is above 0.");
    return table;
}

} // namespace estampe::paper
