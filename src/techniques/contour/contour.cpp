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
#include "shaders/stroke_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/contour/contour.glsl.h"

namespace estampe::contour {

namespace {

using ContourTable = style::Table<ContourStyle>;

void add_width_keys(ContourTable& table)
{
    table
        .number("outline_mm", &ContourStyle::outline_mm, {0.0F, 20.0F}, "mm",
                "Width around objects and before what lies behind")
        .number("boundary_mm", &ContourStyle::boundary_mm, {0.0F, 20.0F}, "mm", "Width between materials")
        .number("crease_mm", &ContourStyle::crease_mm, {0.0F, 20.0F}, "mm", "Width along sharp folds")
        .number("crease_deg", &ContourStyle::crease_deg, {1.0F, 180.0F}, "deg", "Fold from which it is sharp")
        .number("marked_mm", &ContourStyle::marked_mm, {0.0F, 20.0F}, "mm",
                "Width along edges that a glTF file marks, where chains then draw no other folds and "
                "borders; 0 leaves the marks aside")
        .number("ridge_mm", &ContourStyle::ridge_mm, {0.0F, 20.0F}, "mm",
                "Width along rounded folds outwards, drawn by chains; 0 draws none")
        .number("valley_mm", &ContourStyle::valley_mm, {0.0F, 20.0F}, "mm",
                "Width along rounded folds inwards, drawn by chains; 0 draws none")
        .number("ridge_deg", &ContourStyle::ridge_deg, {0.5F, 180.0F}, "deg",
                "How far a surface must turn over a hundredth of its object's size to be a rounded fold")
        .number("suggestive_mm", &ContourStyle::suggestive_mm, {0.0F, 20.0F}, "mm",
                "Width of suggestive contours, where a surface would turn away if the eye moved, drawn by "
                "chains; 0 draws none")
        .number("suggestive_growth", &ContourStyle::suggestive_growth, {0.0F, 10000.0F}, "",
                "How fast a surface there must begin to bend towards the eye, for objects of one size: "
                "less draws more")
        .number("suggestive_deg", &ContourStyle::suggestive_deg, {1.0F, 89.0F}, "deg",
                "Least angle between the view and a surface that has suggestive contours")
        .number("crest_mm", &ContourStyle::crest_mm, {0.0F, 20.0F}, "mm",
                "Width along the brinks of dunes, seen from above too, drawn by chains; 0 draws none")
        .number("crest_deg", &ContourStyle::crest_deg, {0.5F, 89.0F}, "deg",
                "How far the ground must turn across the wind's way at a brink, within one of its cells")
        .number("intersection_mm", &ContourStyle::intersection_mm, {0.0F, 20.0F}, "mm",
                "Width where surfaces run into each other, drawn by chains; 0 draws none")
        .number("shadow_mm", &ContourStyle::shadow_mm, {0.0F, 20.0F}, "mm",
                "Width along edges of the sun's shadows, drawn by chains; 0 draws none")
        .number("depth_step", &ContourStyle::depth_step, {0.05F, 100.0F}, "",
                "How far a surface must fall away behind another to be lined: less draws more");
}

/// Calls `add` for every kind of line that has its own keys.
template <typename Add>
void for_each_line_name(const Add& add)
{
    for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
        if (kind != shared::line_border) { // borders use the keys of outlines
            add(line_kind_keys.at(kind));
        }
    }
}

void add_brush_keys(ContourTable& table)
{
    table.file_or_name("brush", &ContourStyle::brush, brush_names(),
                       "What draws the strokes of chains: a tool, or the PNG of one stroke from left to "
                       "right, in its alpha or in black on white");
    for_each_line_name([&](const LineKindKeys& keys) {
        table.file_or_name(fmt::format("{}_brush", keys.name), keys.brush, brush_names(),
                           fmt::format("Another brush for lines {}; empty for that of all", keys.place));
    });
    table
        .choice("brush_fit", &ContourStyle::brush_fit,
                {{"repeat", BrushFit::repeat}, {"stretch", BrushFit::stretch}},
                "A brush comes again and again along a stroke, at one length and held to the surface as "
                "things move, or once, from end to end")
        .number("brush_mm", &ContourStyle::brush_mm, {0.0F, 1000.0F}, "mm",
                "Length after which a brush repeats; 0 for what its picture makes it at the line's width");
    for_each_line_name([&](const LineKindKeys& keys) {
        table.number(fmt::format("{}_m", keys.name), keys.width_m, {0.0F, 1000.0F}, "m",
                     fmt::format("Width in the scene of lines {}, drawn by chains: nearer is wider; 0 for "
                                 "{}_mm of the page",
                                 keys.place, keys.name));
    });
}

void add_hand_keys(ContourTable& table)
{
    table
        .choice("joints", &ContourStyle::joints, {{"round", Joints::round}, {"mitre", Joints::mitre}},
                "Corners of strokes of chains, and where strokes end at one point")
        .number("pressure", &ContourStyle::pressure, {0.0F, 1.0F}, "",
                "How much the width of a line varies along it")
        .choice("pressure_from", &ContourStyle::pressure_from,
                {{"light", PressureFrom::light}, {"turn", PressureFrom::turn}, {"both", PressureFrom::both}},
                "Where lines swell: in the shade, where strokes of chains bend, or in both")
        .number("distance_thinning", &ContourStyle::distance_thinning, {0.0F, 1.0F}, "",
                "How much lines thin with distance")
        .number("taper_mm", &ContourStyle::taper_mm, {0.0F, 100.0F}, "mm",
                "How far from its ends a stroke of a chain begins to thin")
        .number("overshoot_mm", &ContourStyle::overshoot_mm, {0.0F, 20.0F}, "mm",
                "How far strokes of chains run beyond their ends")
        .number("wobble_mm", &ContourStyle::wobble_mm, {0.0F, 20.0F}, "mm",
                "How far strokes of chains sway to either side")
        .integer("strokes", &ContourStyle::strokes, {1, 3}, "",
                 "How often the hand goes over a line of chains, each time a little otherwise")
        .number("retrace_mm", &ContourStyle::retrace_mm, {0.0F, 20.0F}, "mm",
                "How far later strokes of a line stray from the first")
        .number("jitter_ends_mm", &ContourStyle::jitter_ends_mm, {0.0F, 20.0F}, "mm",
                "How far strokes of chains end too early or too late")
        .number("jitter_offset_mm", &ContourStyle::jitter_offset_mm, {0.0F, 20.0F}, "mm",
                "How far strokes of chains lie beside their line")
        .number("jitter_width", &ContourStyle::jitter_width, {0.0F, 0.9F}, "",
                "How much strokes of chains differ in width, as a share");
}

void add_hidden_keys(ContourTable& table)
{
    table
        .choice("hidden", &ContourStyle::hidden, {{"none", Hidden::none}, {"dashed", Hidden::dashed}},
                "Lines of chains behind something")
        .number("hidden_mm", &ContourStyle::hidden_mm, {0.0F, 20.0F}, "mm", "Width of hidden lines")
        .number("hidden_dash_mm", &ContourStyle::hidden_dash_mm, {0.1F, 100.0F}, "mm",
                "Length of their dashes")
        .number("hidden_gap_mm", &ContourStyle::hidden_gap_mm, {0.1F, 100.0F}, "mm",
                "Length of the gaps between them");
}

} // namespace

const style::Table<ContourStyle>& contour_table()
{
    static const ContourTable table = [] {
        ContourTable made("contour", "Ink lines where surfaces end, meet or fold");
        made.toggle("drawn", &ContourStyle::drawn, "Whether there are lines at all")
            .choice(
                "lines", &ContourStyle::lines, {{"chains", Lines::chains}, {"page", Lines::page}},
                "How lines are found: strokes along true edges (chains), or breaks between pixels (page), "
                "which is the quicker for large meshes")
            .choice("silhouettes", &ContourStyle::silhouettes,
                    {{"smooth", Silhouettes::smooth}, {"edges", Silhouettes::edges}},
                    "Outlines of chains run across the faces as the shading bends, or along the edges")
            .color("ink", &ContourStyle::ink,
                   "Colour of the ink; a material with an outline of its own brings its own");
        add_width_keys(made);
        add_brush_keys(made);
        add_hand_keys(made);
        add_hidden_keys(made);
        made.integer("seed", &ContourStyle::seed, {0, 1000000}, "", "Another hand for another number");
        made.by_surface({"drawn", "ink"});
        for (const LineKindKeys& keys : line_kind_keys) {
            made.by_surface({fmt::format("{}_mm", keys.name), fmt::format("{}_m", keys.name)});
        }
        return made;
    }();
    return table;
}

namespace {

constexpr float most_swelling = 2.2F; // most that pressure, shade and nearness widen a line

constexpr uint32_t listing_groups = 128; // workgroups that share a list whose length is unknown

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
                 (in.only_cut ? shared::edges_only_cut : 0U));
    const gpu::BufferId count = detect.modify(none);
    const gpu::BufferId edges =
        detect.write(graph.buffer("contour/edges", {.size_bytes = capacity * sizeof(shared::EdgePixel)}));
    const gpu::ImageId nearest = detect.write(graph.image(
        "contour/nearest", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r32ui}));
    const float on = style.drawn ? in.pixels_per_mm : 0.0F;
    detect
        .push(shared::EdgeConstants{.outline_px = style.outline_mm * on,
                                    .boundary_px = style.boundary_mm * on,
                                    .crease_px = style.crease_mm * on,
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

/// Half of the widest line's width, plus a pixel.
float half_widest_px(const ContourStyle& style, float pixels_per_mm)
{
    const float widest_mm = std::max({style.outline_mm, style.boundary_mm, style.crease_mm});
    return 0.5F * widest_mm * pixels_per_mm * most_swelling + 1.0F;
}

/// First step of the jump flooding. Steps s, s/2, ..., 1 carry a seed 2s - 1 pixels far.
uint32_t first_step_px(float reach)
{
    return std::bit_ceil((static_cast<uint32_t>(std::ceil(reach)) + 2) / 2);
}

} // namespace

uint32_t reach_px(const ContourStyle& style, float pixels_per_mm)
{
    return style.drawn ? 2 * first_step_px(half_widest_px(style, pixels_per_mm)) : 0;
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
    pass.push(shared::StrokeConstants{
                  .width = in.size_px.x, .height = in.size_px.y, .reach_px = reach, .ink_color = style.ink})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return ink;
}

} // namespace estampe::contour
