// SPDX-License-Identifier: MIT
// Makes strokes from chains: places samples along each chain, tests their visibility, finds the strokes of
// visible samples, and shapes the strokes.
#include <algorithm>

#include "gpu/resources.hpp"
#include "shaders/clear_grid_comp.hpp"
#include "shaders/divide_comp.hpp"
#include "shaders/drop_comp.hpp"
#include "shaders/elect_comp.hpp"
#include "shaders/ends_comp.hpp"
#include "shaders/fill_grid_comp.hpp"
#include "shaders/recall_comp.hpp"
#include "shaders/sample_comp.hpp"
#include "shaders/settle_comp.hpp"
#include "shaders/shape_comp.hpp"
#include "shaders/split_comp.hpp"
#include "shaders/strokes_comp.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/ink/ink.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {

ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains)
{
    const shared::ChainConstants& constants = chains.constants;
    const uint32_t slots_most = constants.segment_capacity + constants.feature_chain_count;
    const uint32_t samples_most = constants.sample_capacity;
    const Scanned lengths = add_scan(graph, "lengths",
                                     {.sizes = chains.sizes,
                                      .values = chains.lengths,
                                      .value_capacity = constants.point_capacity,
                                      .is_spread = in.execution.spreads_scans(),
                                      .constants = scan_of_list(shared::list_points, shared::no_list, 0)});

    auto divide = graph.compute("contour/divide", shaders::divide_comp);
    divide.read(lengths.sizes).sample(chains.points_before, gpu::Format::r32ui);
    divide.read(chains.flags_of_slot).sample(lengths.before, gpu::Format::r32ui);
    const gpu::BufferId samples_of_slot =
        divide.write(graph.buffer("contour/samples of slot", list_of(slots_most, sizeof(uint32_t))));
    const gpu::BufferId no_rotation =
        divide.write(graph.buffer("contour/rotation", list_of(slots_most, sizeof(uint32_t))));
    divide.push(constants).dispatch_indirect(lengths.sizes, indirect_offset(shared::list_slots));
    const Scanned divided =
        add_scan(graph, "samples",
                 {.sizes = lengths.sizes,
                  .values = samples_of_slot,
                  .value_capacity = slots_most,
                  .is_spread = in.execution.spreads_scans(),
                  .constants = scan_of_list(shared::list_slots, shared::list_samples, samples_most)});

    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto sample = graph.compute("contour/sample", shaders::sample_comp);
    sample.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices).read(in.visibility);
    sample.read(divided.sizes);
    for (const gpu::BufferId before : {divided.before, chains.points_before, lengths.before}) {
        sample.sample(before, gpu::Format::r32ui);
    }
    sample.sample(chains.points).read(chains.flags_of_slot).sample(in.neighbors);
    const gpu::BufferId samples =
        sample.write(graph.buffer("contour/samples", list_of(samples_most, sizeof(shared::LineSample))));
    sample.push(constants).dispatch_indirect(divided.sizes, per_sample);

    auto settle = graph.compute("contour/settle", shaders::settle_comp);
    settle.read(divided.sizes).sample(divided.before, gpu::Format::r32ui);
    settle.read(chains.flags_of_slot).sample(samples);
    const gpu::BufferId states =
        settle.write(graph.buffer("contour/states", list_of(samples_most, sizeof(uint32_t))));
    const gpu::BufferId rotation = settle.modify(no_rotation);
    settle.push(shared::SettleConstants{.shortest_px = in.shortest_px, .widest_gap_px = in.pen_px})
        .dispatch_indirect(divided.sizes, per_sample);

    return {.sizes = divided.sizes,
            .lengths_before = lengths.before,
            .samples_before = divided.before,
            .flags_of_slot = chains.flags_of_slot,
            .samples = samples,
            .states = states,
            .rotation = rotation,
            .facing = chains.facing,
            .execution = in.execution};
}

namespace {

/// Enters samples into the sample grid, drops scraps and strokes that run beside a longer stroke, and finds
/// the stroke ends that meet further lines.
ChainStrokes find_ends(gpu::Graph& graph, const ChainInputs& in, const ChainSamples& chains,
                       ChainStrokes strokes, LineClass lines)
{
    const uint32_t cells = grid_cell_count(in.size_px);
    // Of hidden lines, none is a scrap: what they hide themselves is not known.
    const shared::DropConstants constants{.size_px = in.size_px,
                                          .shortest_px = lines == LineClass::seen ? in.shortest_px : 0.0F,
                                          .gap_px = lines == LineClass::seen ? in.gap_px : 0.0F,
                                          .pixels_per_mm = in.pixels_per_mm,
                                          .clump_px = in.foliage ? in.foliage->clump_px : 0.0F};
    auto clear = graph.compute("contour/clear grid", shaders::clear_grid_comp);
    strokes.grid = clear.write(strokes.grid);
    gpu::BufferId shell_lines =
        clear.write(graph.buffer("contour/lines of shells", list_of(in.shell_count + 1, sizeof(uint32_t))));
    clear.push(glm::uvec2(cells, in.shell_count + 1)).dispatch_items(std::max(cells, in.shell_count + 1));
    auto fill = graph.compute("contour/fill grid", shaders::fill_grid_comp);
    fill.read(strokes.sizes).sample(strokes.samples);
    strokes.grid = fill.modify(strokes.grid);
    fill.sample(strokes.strokes_before, gpu::Format::r32ui).read(strokes.strokes).sample(in.neighbors);
    fill.sample(chains.facing, gpu::Format::r32ui);
    shell_lines = fill.modify(shell_lines);
    fill.push(constants).dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
    const auto ask_strokes = [&](gpu::Pass& pass) {
        pass.read(strokes.sizes).sample(strokes.samples).read(strokes.grid);
        pass.sample(strokes.strokes_before, gpu::Format::r32ui);
        strokes.strokes = pass.modify(strokes.strokes);
    };
    auto drop = graph.compute("contour/drop", shaders::drop_comp);
    ask_strokes(drop);
    drop.sample(in.neighbors).sample(chains.facing, gpu::Format::r32ui).read(shell_lines);
    drop.push(constants).dispatch_indirect(strokes.sizes, indirect_offset(shared::list_strokes));
    auto ends = graph.compute("contour/ends", shaders::ends_comp);
    ask_strokes(ends);
    ends.uniform(in.frame)
        .sample(strokes.samples_before, gpu::Format::r32ui)
        .push(in.size_px)
        .variant(in.has_brushes && lines == LineClass::seen ? shared::ends_has_brushes : 0U)
        .dispatch_indirect(strokes.sizes, indirect_offset(shared::list_strokes));
    return strokes;
}

} // namespace

ChainStrokes add_strokes(gpu::Graph& graph, const ChainInputs& lines, const ChainSamples& in,
                         gpu::BufferId grid, LineClass wanted)
{
    const uint32_t samples_most = sample_capacity(lines.size_px);
    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto split = graph.compute("contour/split", shaders::split_comp);
    split.read(in.sizes).sample(in.samples_before, gpu::Format::r32ui);
    split.read(in.flags_of_slot).read(in.rotation);
    split.sample(in.samples)
        .read(in.states)
        .variant(wanted == LineClass::hidden ? shared::split_wants_hidden : 0U);
    const gpu::BufferId cut =
        split.write(graph.buffer("contour/cut samples", list_of(samples_most, sizeof(shared::LineSample))));
    const gpu::BufferId starts =
        split.write(graph.buffer("contour/starts", list_of(samples_most, sizeof(uint32_t))));
    split.dispatch_indirect(in.sizes, per_sample);
    const Scanned started =
        add_scan(graph, "strokes",
                 {.sizes = in.sizes,
                  .values = starts,
                  .value_capacity = samples_most,
                  .is_spread = in.execution.spreads_scans(),
                  .constants = scan_of_list(shared::list_samples, shared::list_strokes, samples_most)});

    auto bounds = graph.compute("contour/strokes", shaders::strokes_comp);
    bounds.read(started.sizes).sample(cut).sample(started.before, gpu::Format::r32ui);
    const gpu::BufferId strokes =
        bounds.write(graph.buffer("contour/strokes", list_of(samples_most, sizeof(shared::Stroke))));
    bounds.dispatch_indirect(started.sizes, per_sample);
    return find_ends(graph, lines, in,
                     {.sizes = started.sizes,
                      .samples = cut,
                      .samples_before = in.samples_before,
                      .strokes_before = started.before,
                      .strokes = strokes,
                      .grid = grid},
                     wanted);
}

namespace {

constexpr float sway_wave_mm = 9.0F; // approximate wavelength of the hand's wobble
constexpr float turn_mm = 5.0F;      // radius of a bend at which the pen's pressure is greatest
constexpr float settling = 0.02F;

/// Whether the brushes of visible or hidden lines stretch over the whole stroke.
bool stretches(const ContourStyle& style, LineClass lines)
{
    return style.brush_fit == BrushFit::stretch && lines == LineClass::seen;
}

/// Adds passes that match strokes with the strokes of the previous frame.
gpu::BufferId add_recall(gpu::Graph& graph, ChainStrokes& strokes, LineHistory& history,
                         const ContourInputs& page, const ContourStyle& style, LineClass lines)
{
    const shared::RecallConstants constants{.clip_from_anchor_before = history.clip_from_anchor_before(),
                                            .width = page.size_px.x,
                                            .height = page.size_px.y,
                                            .stretches = stretches(style, lines) ? 1U : 0U};
    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto recall = graph.compute("contour/recall", shaders::recall_comp);
    recall.read(strokes.sizes).sample(strokes.samples);
    recall.sample(strokes.strokes_before, gpu::Format::r32ui);
    strokes.strokes = recall.modify(strokes.strokes);
    recall.read(gpu::import_whole(graph, "grid before", history.before(lines).grid));
    recall.read(gpu::import_whole(graph, "samples before", history.before(lines).samples));
    const gpu::BufferId recalls = recall.write(
        graph.buffer("contour/recalls", list_of(sample_capacity(page.size_px), sizeof(shared::Recall))));
    recall.push(constants).dispatch_indirect(strokes.sizes, per_sample);
    auto elect = graph.compute("contour/elect", shaders::elect_comp);
    elect.read(strokes.sizes).sample(strokes.samples);
    elect.sample(strokes.strokes_before, gpu::Format::r32ui).read(recalls);
    strokes.strokes = elect.modify(strokes.strokes);
    elect.push(constants).dispatch_indirect(strokes.sizes, per_sample);
    return recalls;
}

/// Inputs of the pass that computes the path and width of the pen (shape.comp).
struct ShapeInputs {
    const ContourInputs& page;
    const ChainInputs& mesh;
    gpu::BufferId facing;
    const ChainStrokes& strokes;
    gpu::BufferId recalls; ///< data inherited from the previous frame; unused if there is no previous frame
    LineHistory* history;
    LineClass lines;
    uint32_t hand; ///< how many times the strokes have already been drawn
};

/// Variant bits of shape.comp that a style needs.
uint32_t shape_variant(const ShapeInputs& in, const ContourStyle& style)
{
    const bool is_hidden = in.lines == LineClass::hidden;
    const bool recalls_frame = in.history != nullptr && in.history->holds_frame(in.lines);
    const bool is_remembered = in.history != nullptr && in.hand == 0;
    const uint32_t basic = (recalls_frame ? shared::shape_recalls_frame : 0U) |
                           (is_remembered ? shared::shape_is_remembered : 0U) |
                           (in.page.brushes != nullptr ? shared::shape_has_brushes : 0U) |
                           (style.wobble_mm > 0.0F ? shared::shape_has_sway : 0U) |
                           (in.page.variant_of_draw ? shared::shape_has_variants : 0U) |
                           (in.page.has_inks_by_kind ? shared::shape_has_inks_by_kind : 0U);
    if (is_hidden) {
        return basic | shared::shape_is_hidden;
    }
    const bool strays = in.hand > 0 || style.jitter_ends_mm > 0.0F || style.jitter_offset_mm > 0.0F ||
                        style.jitter_width > 0.0F;
    const bool has_widths_m = std::ranges::any_of(line_kinds, [&](const LineKind& kind) {
        const LineStyle& line = style.*kind.style;
        return line.enabled && line.width_m > 0.0F;
    });
    return basic | (stretches(style, in.lines) ? shared::shape_stretches : 0U) |
           (in.page.own_outlines ? shared::shape_has_own_outlines : 0U) |
           (strays ? shared::shape_has_jitter : 0U) | (has_widths_m ? shared::shape_has_widths_m : 0U) |
           (style.pressure_from != PressureFrom::light ? shared::shape_swells_in_turns : 0U) |
           (style.pressure_from == PressureFrom::turn ? shared::shape_is_even_in_shade : 0U);
}

/// Sets the width of a kind of line. `To` is a struct with the width members of shared::ShapeConstants.
template <class To>
void set_width(const ContourStyle& style, uint32_t kind, float pixels_per_mm, To& to)
{
    const LineStyle& line = line_style(style, kind);
    const bool is_in_metres = line.enabled && line.width_m > 0.0F;
    to.width_of_kind[kind] = is_in_metres ? line.width_m : width_on_page_mm(style, kind) * pixels_per_mm;
    to.metre_kinds |= is_in_metres ? 1U << kind : 0U;
}

void set_widths(const ShapeInputs& in, const ContourStyle& style, shared::ShapeConstants& constants)
{
    for (uint32_t kind = 0; kind < shared::line_kind_count && style.enabled; ++kind) {
        if (in.lines == LineClass::hidden) {
            constants.width_of_kind[kind] =
                has_lines(style, kind) ? style.hidden.width_mm * in.page.pixels_per_mm : 0.0F;
        } else {
            set_width(style, kind, in.page.pixels_per_mm, constants);
        }
    }
}

shared::ShapeConstants shape_constants(const ShapeInputs& in, const ContourStyle& style)
{
    const float pixels_per_mm = style.enabled ? in.page.pixels_per_mm : 0.0F;
    shared::ShapeConstants constants{.taper_px = style.taper_mm * pixels_per_mm,
                                     .overshoot_px = style.overshoot_mm * pixels_per_mm,
                                     .wobble_px = style.wobble_mm * pixels_per_mm,
                                     .pressure = style.pressure,
                                     .distance_thinning = style.distance_thinning,
                                     .seed = static_cast<uint32_t>(style.seed),
                                     .wave_px = sway_wave_mm * pixels_per_mm,
                                     .settling = in.page.is_moving ? settling : 0.0F,
                                     .turn_px = turn_mm * pixels_per_mm,
                                     .hand = in.hand,
                                     .retrace_px = style.retrace_mm * pixels_per_mm,
                                     .jitter_ends_px = style.jitter_ends_mm * pixels_per_mm,
                                     .jitter_offset_px = style.jitter_offset_mm * pixels_per_mm,
                                     .jitter_width = style.jitter_width,
                                     .rank = style.rank,
                                     .lost = style.lost,
                                     .gap_px = style.gap_mm * pixels_per_mm};
    for (uint32_t use = 0; in.page.brushes != nullptr && use < shared::brush_use_count; ++use) {
        constants.brush_uses |= in.page.brushes->layer_of_use.at(use) ? 1U << use : 0U;
    }
    set_widths(in, style, constants);
    if (in.lines == LineClass::hidden) {
        constants.taper_px = constants.overshoot_px = constants.pressure = 0.0F;
        constants.rank = constants.lost = constants.gap_px = 0.0F;
    }
    return constants;
}

/// Adds the pass that computes path and width of the pen. If strokes are drawn several times, only the first
/// drawing is stored for the next frame.
HandDrawn add_shape(gpu::Graph& graph, const ShapeInputs& in, const ContourStyle& style)
{
    const ContourInputs& page = in.page;
    const uint64_t points_most = 2ULL * sample_capacity(page.size_px);
    auto shape = graph.compute("contour/shape", shaders::shape_comp);
    shape.uniform(page.frame).read(in.strokes.sizes).sample(in.strokes.samples);
    shape.sample(in.strokes.strokes_before, gpu::Format::r32ui);
    shape.read(in.strokes.strokes).sample(in.mesh.line_triangles).sample(in.mesh.neighbors);
    shape.sample(in.facing, gpu::Format::r32ui).sample(page.light).sample(page.draws).sample(page.materials);
    const gpu::BufferId line_points =
        shape.write(graph.buffer("contour/line points", list_of(points_most, sizeof(shared::LinePoint))));
    shape.read(in.recalls);
    const gpu::BufferId remembered =
        shape.write(in.history != nullptr && in.hand == 0
                        ? gpu::import_whole(graph, "samples now", in.history->now(in.lines).samples)
                        : graph.buffer("contour/unremembered", list_of(1, sizeof(shared::DrawnSample))));
    static_cast<void>(remembered);
    const gpu::BufferId touches = shape.write(graph.buffer(
        "contour/touches", list_of(page.brushes != nullptr ? points_most : 1, sizeof(shared::LineTouch))));
    shape.sample(page.variant_of_draw.value_or(page.draws), gpu::Format::r32ui);
    shape.sample(page.variant_lines.value_or(page.draws), gpu::Format::r32ui);
    shape.variant(shape_variant(in, style))
        .push(shape_constants(in, style))
        .dispatch_indirect(in.strokes.sizes, indirect_offset(shared::list_samples));
    return {line_points, touches};
}

/// Makes strokes of the visible or the hidden lines, drawn as many times as the style asks for.
std::pair<ChainStrokes, InlineVector<HandDrawn, most_hands>>
add_class(gpu::Graph& graph, const ContourInputs& page, const ChainInputs& mesh, gpu::BufferId facing,
          const ChainSamples& samples, LineHistory* history, const ContourStyle& style, LineClass lines)
{
    const gpu::BufferId grid =
        history != nullptr
            ? gpu::import_whole(graph, "grid now", history->now(lines).grid)
            : graph.buffer("contour/grid", list_of(grid_cell_count(page.size_px), sizeof(glm::uvec2)));
    ChainStrokes strokes = add_strokes(graph, mesh, samples, grid, lines);
    const bool recalls_frame = history != nullptr && history->holds_frame(lines);
    const gpu::BufferId recalls =
        recalls_frame ? add_recall(graph, strokes, *history, page, style, lines) : strokes.strokes_before;
    const uint32_t hand_count = lines == LineClass::hidden ? 1 : static_cast<uint32_t>(style.strokes);
    InlineVector<HandDrawn, most_hands> hands;
    for (uint32_t hand = 0; hand < hand_count; ++hand) {
        hands.push_back(add_shape(graph,
                                  {.page = page,
                                   .mesh = mesh,
                                   .facing = facing,
                                   .strokes = strokes,
                                   .recalls = recalls,
                                   .history = history,
                                   .lines = lines,
                                   .hand = hand},
                                  style));
    }
    return {strokes, hands};
}

} // namespace

shared::VariantLines variant_lines_of(const ContourStyle& style, float pixels_per_mm)
{
    shared::VariantLines lines{};
    for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
        lines.ink_of_kind[kind] = ink_of_kind(style, kind);
        if (style.enabled) {
            set_width(style, kind, pixels_per_mm, lines);
        }
    }
    return lines;
}

ShapedStrokes add_shaped_strokes(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                 LineHistory* history, const ContourStyle& style)
{
    const ChainInputs lines = chain_inputs(graph, in, mesh, style);
    const Chains chains = add_chains(graph, lines, mesh, style.silhouettes == Silhouettes::edges);
    ChainSamples samples = add_samples(graph, lines, chains);
    // If the pen draws all visible lines, no brushes are needed.
    ContourInputs page = in;
    page.brushes = brushes_of_seen_lines(in.brushes);
    auto [seen, hands] =
        add_class(graph, page, lines, chains.facing, samples, history, style, LineClass::seen);
    ShapedStrokes shaped{.strokes = seen, .facing = chains.facing, .hands = hands, .hidden = {}};
    if (style.hidden.enabled) {
        samples.sizes = seen.sizes;
        auto [hidden, hidden_hands] =
            add_class(graph, in, lines, chains.facing, samples, history, style, LineClass::hidden);
        shaped.strokes.sizes = hidden.sizes;
        shaped.hidden.emplace(hidden, hidden_hands.front());
    }
    return shaped;
}

} // namespace estampe::contour
