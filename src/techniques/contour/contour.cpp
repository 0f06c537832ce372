// SPDX-License-Identifier: MIT
#include "techniques/contour/contour.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "gpu/transfers.hpp"
#include "shaders/edges_comp.hpp"
#include "shaders/flood_comp.hpp"
#include "shaders/seeds_comp.hpp"
#include "shaders/spare_comp.hpp"
#include "shaders/stroke_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/contour/contour.glsl.h"

namespace estampe::contour {

namespace {

using ContourTable = style::Table<ContourStyle>;

void add_line_keys(ContourTable& table, const LineKind& kind, const char* lines)
{
    const std::string name = kind.name;
    const auto of = [&](auto LineStyle::*member) { return style::within(kind.style, member); };
    table.toggle(name + ".enabled", of(&LineStyle::enabled), fmt::format("Turns on {}", lines))
        .number(name + ".width_mm", of(&LineStyle::width_mm), {0.02F, 20.0F}, "mm",
                fmt::format("Width on the page of lines {}: more is bolder", kind.place))
        .number(name + ".width_m", of(&LineStyle::width_m), {0.0F, 1000.0F}, "m",
                fmt::format("Width, in metres of the scene, of lines {}. Near lines look wider on the page. "
                            "0 uses contour.{}.width_mm instead. Only used when contour.lines is chains.",
                            kind.place, name))
        .file_or_name(
            name + ".brush", of(&LineStyle::brush), brush_names(),
            fmt::format(
                "Tool that draws lines {}. The tool is pen, pencil, charcoal, brush, or a PNG picture of one "
                "stroke. If empty, contour.brush is used. Only used when contour.lines is chains.",
                kind.place))
        .color_or_auto(
            name + ".ink", of(&LineStyle::ink),
            fmt::format("Colour of lines {}. The value auto uses the colour contour.ink. Only used when "
                        "contour.lines is chains.",
                        kind.place));
}

void add_kind_keys(ContourTable& table)
{
    const auto add = [&table](uint32_t kind, const char* lines) {
        add_line_keys(table, line_kinds.at(kind), lines);
    };
    add(shared::line_silhouette, "outlines: lines around objects and in front of other surfaces");
    add(shared::line_boundary, "lines along the border between two materials");
    add(shared::line_crease, "lines along sharp folds (creases)");
    table.number("crease.angle_deg", &ContourStyle::crease_deg, {1.0F, 180.0F}, "deg",
                 "Smallest angle by which a surface must bend at a fold to get a line. Less draws more "
                 "lines, more draws only sharp folds.");
    add(shared::line_marked, "lines along edges that a glTF file marks. These lines replace the lines along "
                             "other folds and borders of the mesh.");
    add(shared::line_ridge, "ridge lines: lines along rounded folds that point outwards");
    table.number("ridge.turn_deg", &ContourStyle::ridge_deg, {0.5F, 180.0F}, "deg",
                 "Smallest angle by which a rounded fold must bend to get a ridge or valley line. The bend "
                 "is measured over one hundredth of the object's size. Less draws more lines. Only used when "
                 "contour.lines is chains.");
    add(shared::line_valley, "valley lines: lines along grooves, which are rounded folds that point inwards");
    add(shared::line_suggestive,
        "suggestive contours (almost-outlines): lines where a small step aside would show an outline");
    table
        .number("suggestive.growth", &ContourStyle::suggestive_growth, {0.0F, 10000.0F}, "",
                "Smallest strength at which suggestive contours (lines that are almost outlines) are drawn. "
                "Less draws more of these lines, more leaves only the clearest. Only used when contour.lines "
                "is chains.")
        .number("suggestive.angle_deg", &ContourStyle::suggestive_deg, {1.0F, 89.0F}, "deg",
                "How far a surface must be turned away from the camera to get suggestive contours "
                "(almost-outlines). More draws fewer of these lines, because surfaces that face the camera "
                "get none. Only used when contour.lines is chains.");
    add(shared::line_crest, "lines along the crests of dunes, even when seen from above");
    table.number("crest.angle_deg", &ContourStyle::crest_deg, {0.5F, 89.0F}, "deg",
                 "Smallest bend of the ground along the wind at which the crest of a dune gets a line. Less "
                 "draws more lines. The bend is measured within one cell of the ground's mesh. Only used "
                 "when contour.lines is chains.");
    add(shared::line_intersection, "lines where surfaces pass through each other");
    add(shared::line_shadow, "lines along the edges of the sun's shadows");
    add(shared::line_leaf, "marks on clumps of leaves, where the light ends on them");
    table.number("clump_mm", &ContourStyle::clump_mm, {0.0F, 50.0F}, "mm",
                 "Size of the gaps between leaves that are drawn as one clump. Leaves, hair and fences are "
                 "surfaces that a texture's alpha cuts out. More draws simpler clumps, 0 draws every leaf. "
                 "Only used when contour.lines is chains.");
}

void add_brush_keys(ContourTable& table)
{
    table
        .number("depth_step", &ContourStyle::depth_step, {0.05F, 100.0F}, "",
                "Smallest step in depth at which a surface gets an outline against the surface behind. Less "
                "draws more lines. Only used when contour.lines is page, and for shapes cut out by a "
                "texture's transparency (alpha) that are no leaves.")
        .file_or_name("brush", &ContourStyle::brush, brush_names(),
                      "Tool that draws ink lines: pen, pencil, charcoal, brush, or a PNG of one stroke from "
                      "left to right. The PNG has the stroke in its alpha channel or in black on white. Only "
                      "used when contour.lines is chains.")
        .choice("brush_fit", &ContourStyle::brush_fit,
                {{"repeat", BrushFit::repeat}, {"stretch", BrushFit::stretch}},
                "How the picture of a brush is laid along an ink line. repeat: again and again at one "
                "length, fixed to the surface when things move; stretch: once, from end to end. Only used "
                "when contour.lines is chains.")
        .number("brush_mm", &ContourStyle::brush_mm, {0.0F, 1000.0F}, "mm",
                "Length along an ink line after which the picture of the brush repeats. More makes the "
                "picture longer. 0 uses the length at which the picture keeps its proportions. Only used "
                "when contour.brush_fit is repeat.");
}

void add_hand_keys(ContourTable& table)
{
    table
        .choice("joints", &ContourStyle::joints, {{"round", Joints::round}, {"mitre", Joints::mitre}},
                "Shape of ink lines at corners, and where several lines end together. round: rounded; mitre: "
                "pointed. Only used when contour.lines is chains.")
        .number("pressure", &ContourStyle::pressure, {0.0F, 1.0F}, "",
                "How much the width of ink lines varies along each line. 0 is even, as from a technical pen, "
                "1 varies most.")
        .choice("pressure_from", &ContourStyle::pressure_from,
                {{"light", PressureFrom::light}, {"turn", PressureFrom::turn}, {"both", PressureFrom::both}},
                "Where ink lines get wider. light: in shade; turn: where a line bends; both: in shade and at "
                "bends. turn and both need contour.lines to be chains.")
        .number(
            "rank", &ContourStyle::rank, {0.0F, 1.0F}, "",
            "How much outlines differ in width by what they say. Outlines before something far away and "
            "edges that touch the ground get wider, outlines before something near get finer. 0 draws all "
            "equally wide. Only used when contour.lines is chains.")
        .number("lost", &ContourStyle::lost, {0.0F, 1.0F}, "",
                "How far ink lines are left out in the light (lost and found edges). 0 draws lines all "
                "around a shape, 1 leaves lines only in shade. Only used when contour.lines is chains.")
        .number("spared", &ContourStyle::spared, {0.0F, 1.0F}, "",
                "How far ink lines are left white where they run through solid black, see hatch.black_above. "
                "0 draws such lines black, so that these lines are lost; 1 leaves such lines white.")
        .number("gap_mm", &ContourStyle::gap_mm, {0.0F, 20.0F}, "mm",
                "How far an ink line stops before a nearer line behind which it goes on. 0 draws up to the "
                "nearer line, more leaves a white gap that shows which shape is in front. Only used when "
                "contour.lines is chains.")
        .number("distance_thinning", &ContourStyle::distance_thinning, {0.0F, 1.0F}, "",
                "How much thinner ink lines are in the distance. 0 keeps one width, 1 makes far lines about "
                "a third as wide as near lines.")
        .number("shortest_mm", &ContourStyle::shortest_mm, {0.0F, 20.0F}, "mm",
                "Length of the shortest ink line. Shorter parts of lines are left out as scraps; 0 draws all "
                "of them. Only used when contour.lines is chains.")
        .number("taper_mm", &ContourStyle::taper_mm, {0.0F, 100.0F}, "mm",
                "Length over which an ink line thins towards its free ends. 0 gives blunt ends, more gives "
                "pointed ends. Only used when contour.lines is chains.")
        .number("overshoot_mm", &ContourStyle::overshoot_mm, {0.0F, 20.0F}, "mm",
                "How far ink lines run past their ends, as in an architect's sketch. 0 stops at the corner, "
                "more crosses further. Only used when contour.lines is chains.")
        .number("wobble_mm", &ContourStyle::wobble_mm, {0.0F, 20.0F}, "mm",
                "How far ink lines waver to either side of the true edge: 0 is exact, more is a shaky hand. "
                "Only used when contour.lines is chains.")
        .integer("strokes", &ContourStyle::strokes, {1, 3}, "",
                 "How many times each ink line is drawn: 1 is a clean line, 2 and 3 look sketched. Only used "
                 "when contour.lines is chains.")
        .number("retrace_mm", &ContourStyle::retrace_mm, {0.0F, 20.0F}, "mm",
                "How far the second and third stroke of an ink line lie from the first: more looks "
                "sketchier. Only used when contour.strokes is 2 or 3.")
        .number("jitter_ends_mm", &ContourStyle::jitter_ends_mm, {0.0F, 20.0F}, "mm",
                "How far ink lines end before or after their true end, at random: more is a looser sketch. "
                "Only used when contour.lines is chains.")
        .number("jitter_offset_mm", &ContourStyle::jitter_offset_mm, {0.0F, 20.0F}, "mm",
                "How far ink lines are shifted sideways from the true edge, at random: more is a looser "
                "sketch. Only used when contour.lines is chains.")
        .number("jitter_width", &ContourStyle::jitter_width, {0.0F, 0.9F}, "",
                "How much ink lines differ in width from each other, at random. 0 draws all lines of a kind "
                "equally wide, more is livelier. Only used when contour.lines is chains.");
}

void add_hidden_keys(ContourTable& table)
{
    const auto of = [](auto HiddenStyle::*member) { return style::within(&ContourStyle::hidden, member); };
    table
        .toggle("hidden.enabled", of(&HiddenStyle::enabled),
                "Turns hidden lines on: lines behind other surfaces are drawn with dashes, as in a technical "
                "drawing. Only used when contour.lines is chains.")
        .number("hidden.width_mm", of(&HiddenStyle::width_mm), {0.02F, 20.0F}, "mm",
                "Width on the page of hidden lines (lines behind other surfaces): more is bolder. Only used "
                "when contour.hidden.enabled is true.")
        .number("hidden.dash_mm", of(&HiddenStyle::dash_mm), {0.1F, 100.0F}, "mm",
                "Length on the page of the dashes of hidden lines (lines behind other surfaces). Only used "
                "when contour.hidden.enabled is true.")
        .number("hidden.gap_mm", of(&HiddenStyle::gap_mm), {0.1F, 100.0F}, "mm",
                "Length on the page of the gaps between the dashes of hidden lines (lines behind other "
                "surfaces). Only used when contour.hidden.enabled is true.");
}

} // namespace

bool has_inks_by_kind(const ContourStyle& style)
{
    return std::ranges::any_of(line_kinds, [&](const LineKind& kind) {
        const LineStyle& line = style.*kind.style;
        return line.enabled && line.ink.has_value();
    });
}

const style::Table<ContourStyle>& contour_table()
{
    static const ContourTable table = [] {
        ContourTable made("contour", "Ink lines: outlines, folds, and where surfaces meet");
        made.toggle("enabled", &ContourStyle::enabled,
                    "Turns ink lines on: outlines, folds, borders between materials and other lines")
            .choice("lines", &ContourStyle::lines, {{"chains", Lines::chains}, {"page", Lines::page}},
                    "How ink lines are found. chains: along the edges of the 3D model, as connected strokes "
                    "that may have taper, brushes and dashes; page: from the pixels of the picture, without "
                    "these, which is quicker for large models.")
            .choice("silhouettes", &ContourStyle::silhouettes,
                    {{"smooth", Silhouettes::smooth}, {"edges", Silhouettes::edges}},
                    "Where the outline of a smooth surface runs. smooth: as a smooth curve across the "
                    "triangles of the mesh; edges: along the edges of the triangles. Only used when "
                    "contour.lines is chains.")
            .color("ink", &ContourStyle::ink,
                   "Colour of the ink lines. A material that brings its own outline (toon material) keeps "
                   "the colour of that outline.");
        add_brush_keys(made);
        add_kind_keys(made);
        add_hand_keys(made);
        add_hidden_keys(made);
        made.by_surface({"enabled", "ink"});
        for (const LineKind& kind : line_kinds) {
            made.by_surface({fmt::format("{}.enabled", kind.name), fmt::format("{}.width_mm", kind.name),
                             fmt::format("{}.width_m", kind.name), fmt::format("{}.ink", kind.name)});
        }
        return made;
    }();
    return table;
}

namespace {

// Largest factor by which pressure, shade and nearness together widen a line.
constexpr float most_swelling = 2.2F;

// Number of workgroups that process a list whose length the CPU does not know.
constexpr uint32_t listing_groups = 128;

struct Seeds {
    gpu::ImageId seed;
    gpu::ImageId nearest;
};

Seeds add_seeds(gpu::Graph& graph, const ContourInputs& in, const ContourStyle& style)
{
    const uint32_t capacity = in.size_px.x * in.size_px.y;
    const gpu::BufferId none = gpu::add_zeros(graph, "contour/count", 16);

    auto detect = graph.compute("contour/edges", shaders::edges_comp);
    detect.uniform(in.frame).sample(in.draws).sample(in.draw).sample(in.depth).sample(in.normal);
    detect.sample(in.screen_draw)
        .variant((in.has_screen ? shared::edges_has_screen : 0U) |
                 (in.only_cut ? shared::edges_only_cut : 0U) |
                 (in.has_clumps ? shared::edges_has_clumps : 0U));
    const gpu::BufferId count = detect.modify(none);
    const gpu::BufferId edges =
        detect.write(graph.buffer("contour/edges", {.size_bytes = capacity * sizeof(shared::EdgePixel)}));
    const gpu::ImageId nearest = detect.write(graph.image(
        "contour/nearest", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32ui}));
    const float on = style.enabled ? in.pixels_per_mm : 0.0F;
    detect
        .push(shared::EdgeConstants{.outline_px = width_on_page_mm(style, shared::line_silhouette) * on,
                                    .boundary_px = width_on_page_mm(style, shared::line_boundary) * on,
                                    .crease_px = width_on_page_mm(style, shared::line_crease) * on,
                                    .crease_cosine = std::cos(glm::radians(style.crease_deg)),
                                    .depth_step = 12.0F * style.depth_step * in.pixel_m_at_one,
                                    .capacity = capacity})
        .dispatch_over(in.size_px.x, in.size_px.y);

    auto place = graph.compute("contour/seeds", shaders::seeds_comp);
    place.uniform(in.frame).read(in.visibility).sample(in.triangles).sample(in.posed_vertices);
    place.sample(in.depth).sample(in.coordinate).sample(in.light).read(count).read(edges);
    place.sample(in.draw)
        .sample(in.draws)
        .sample(in.materials)
        .variant(in.own_outlines ? shared::seeds_has_own_outlines : 0U);
    const gpu::ImageId seed = place.write(graph.image(
        "contour/seed", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f}));
    place
        .push(shared::SeedConstants{.pressure = style.pressure,
                                    .distance_thinning = style.distance_thinning,
                                    .pixel_m_at_one = in.pixel_m_at_one,
                                    .capacity = capacity})
        .dispatch(std::min(capacity / 64 + 1, listing_groups));
    return {seed, nearest};
}

gpu::ImageId add_flood(gpu::Graph& graph, gpu::ImageId nearest, glm::uvec2 size_px, uint32_t step_px)
{
    auto pass = graph.compute("contour/flood", shaders::flood_comp);
    pass.sample(nearest);
    const gpu::ImageId flooded = pass.write(graph.image("contour/nearest", graph.describe(nearest)));
    pass.push(shared::FloodConstants{.width = size_px.x, .height = size_px.y, .step_px = step_px})
        .dispatch_over(size_px.x, size_px.y);
    return flooded;
}

/// Half of the widest line's width plus one pixel, in pixels.
float half_widest_px(const ContourStyle& style, float pixels_per_mm)
{
    const float widest_mm = std::max({width_on_page_mm(style, shared::line_silhouette),
                                      width_on_page_mm(style, shared::line_boundary),
                                      width_on_page_mm(style, shared::line_crease)});
    return 0.5F * widest_mm * pixels_per_mm * most_swelling + 1.0F;
}

/// First step of the jump flooding, in pixels. Each step of the flooding is half as long as the step before,
/// down to one pixel. A seed spreads over twice the first step minus one pixel.
uint32_t first_step_px(float reach)
{
    return std::bit_ceil((static_cast<uint32_t>(std::ceil(reach)) + 2) / 2);
}

} // namespace

uint32_t reach_px(const ContourStyle& style, float pixels_per_mm)
{
    return style.enabled ? 2 * first_step_px(half_widest_px(style, pixels_per_mm)) : 0;
}

bool spares_lines(const ContourStyle& style)
{
    return style.enabled && style.spared > 0.0F;
}

uint32_t spare_reach_px(const ContourStyle& style, float pixels_per_mm)
{
    return static_cast<uint32_t>(std::ceil(half_widest_px(style, pixels_per_mm))) + 1;
}

InkImages add_spared(gpu::Graph& graph, const InkImages& ink, const ContourStyle& style, float pixels_per_mm)
{
    const gpu::ImageDesc desc = graph.describe(ink.hatch);
    auto pass = graph.compute("contour/spare", shaders::spare_comp);
    pass.sample(ink.hatch);
    const gpu::ImageId lines = pass.modify(ink.lines);
    const gpu::ImageId hatch = pass.write(graph.image(
        "hatch/spared", {.width = desc.width, .height = desc.height, .format = gpu::Format::r16f}));
    pass.push(shared::SpareConstants{.size_px = {desc.width, desc.height},
                                     .reach_px = spare_reach_px(style, pixels_per_mm),
                                     .spared = style.spared})
        .dispatch_over(desc.width, desc.height);
    return {hatch, lines};
}

gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in, const ContourStyle& style)
{
    Seeds seeds = add_seeds(graph, in, style);
    const float reach = half_widest_px(style, in.pixels_per_mm);
    for (uint32_t step = first_step_px(reach); step > 0; step /= 2) {
        seeds.nearest = add_flood(graph, seeds.nearest, in.size_px, step);
    }
    auto pass = graph.compute("contour/stroke", shaders::stroke_comp);
    pass.sample(seeds.nearest).sample(seeds.seed).sample(in.draw).sample(in.draws).sample(in.materials);
    pass.variant(in.own_outlines ? shared::stroke_has_own_outlines : 0U);
    const gpu::ImageId ink = pass.write(graph.image(
        "contour/ink", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba8}));
    pass.push(shared::StrokeConstants{.width = in.size_px.x,
                                      .height = in.size_px.y,
                                      .reach_px = reach,
                                      .ink_color = in.only_cut ? ink_of_kind(style, shared::line_silhouette)
                                                               : style.ink})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::contour
