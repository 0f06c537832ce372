// SPDX-License-Identifier: MIT
#include "gpu/graph/execute.hpp"
#include "gpu/imports.hpp"
#include "shaders/blank_layer_comp.hpp"
#include "shaders/clear_grid_comp.hpp"
#include "shaders/divide_comp.hpp"
#include "shaders/drop_comp.hpp"
#include "shaders/elect_comp.hpp"
#include "shaders/ends_comp.hpp"
#include "shaders/fill_grid_comp.hpp"
#include "shaders/ink_layer_comp.hpp"
#include "shaders/ink_pieces_comp.hpp"
#include "shaders/recall_comp.hpp"
#include "shaders/sample_comp.hpp"
#include "shaders/settle_comp.hpp"
#include "shaders/shape_comp.hpp"
#include "shaders/split_comp.hpp"
#include "shaders/strokes_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan.hpp"

namespace estampe::contour {
namespace {

shared::ScanConstants scan_of(uint32_t values_of, uint32_t total_to, uint32_t capacity)
{
    return {.fixed_count = 0,
            .count_of = values_of,
            .total_to = total_to,
            .capacity = capacity,
            .slots_before = shared::no_list,
            .counts_bits = 0};
}

/// What lines have inked.
struct Inked {
    gpu::BufferId pixels; ///< a word each
    gpu::BufferId tiles;  ///< see ink_tiles.glsl
};

/// A buffer of zeros, behind the arguments of a dispatch of no workgroups if it `starts_with_groups`.
gpu::BufferId add_zeros(gpu::Graph& graph, const char* name, uint64_t size_bytes, bool starts_with_groups)
{
    auto clear = graph.custom(name);
    const gpu::BufferId zeros =
        clear.touch_write(graph.buffer(name, {.size_bytes = size_bytes}), gpu::Access::transfer_write);
    clear.execute([=](gpu::Recorder& recorder) {
        const auto fill = [&](uint64_t from, uint64_t to, uint32_t word) {
            vkCmdFillBuffer(recorder.commands(), recorder.buffer(zeros).handle(), from, to - from, word);
        };
        fill(0, 4, 0);
        fill(4, 12, starts_with_groups ? 1 : 0);
        fill(12, size_bytes, 0);
    });
    return zeros;
}

Inked add_ink(gpu::Graph& graph, const ChainStrokes& strokes, gpu::BufferId line_points,
              const shared::InkConstants& constants)
{
    const uint64_t tiles = uint64_t{(constants.width + 7) / 8} * ((constants.height + 7) / 8);
    const gpu::BufferId blank =
        add_zeros(graph, "contour/inked", sizeof(uint32_t) * constants.width * constants.height + 16, false);
    const gpu::BufferId no_tiles = add_zeros(graph, "contour/ink tiles", 16 + 8 * tiles, true);
    auto ink = graph.compute("contour/ink pieces", shaders::ink_pieces_comp);
    ink.read(strokes.sizes).sample(strokes.samples).read(line_points);
    const gpu::BufferId inked = ink.modify(blank);
    const gpu::BufferId listed = ink.modify(no_tiles);
    ink.push(constants).dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
    return {inked, listed};
}

/// A processor fills an image quicker by itself than by threads; a GPU is the other way round.
gpu::ImageId add_blank_layer(gpu::Graph& graph, const shared::InkConstants& constants, bool on_processor)
{
    const gpu::ImageId layer = graph.image(
        "contour/ink", {.width = constants.width, .height = constants.height, .format = gpu::Format::rgba8});
    if (!on_processor) {
        auto pass = graph.compute("contour/blank layer", shaders::blank_layer_comp);
        const gpu::ImageId blank = pass.write(layer);
        pass.push(constants).dispatch_over(constants.width, constants.height);
        return blank;
    }
    auto clear = graph.custom("contour/blank layer");
    const gpu::ImageId blank = clear.touch_write(layer, gpu::Access::transfer_write);
    clear.execute([blank, color = glm::sqrt(constants.ink_color)](gpu::Recorder& recorder) {
        const VkClearColorValue paper{.float32 = {color.x, color.y, color.z, 0.0F}};
        const VkImageSubresourceRange whole{
            .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
        vkCmdClearColorImage(recorder.commands(), recorder.image(blank).handle(),
                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &paper, 1, &whole);
    });
    return blank;
}

/// Enters samples into the grid, drops what runs beside a longer stroke, and asks of the ends of each stroke
/// whether they meet other lines.
ChainStrokes find_ends(gpu::Graph& graph, ChainStrokes strokes, glm::uvec2 size_px)
{
    const uint32_t cells = grid_cell_count(size_px);
    auto clear = graph.compute("contour/clear grid", shaders::clear_grid_comp);
    strokes.grid = clear.write(strokes.grid);
    clear.push(cells).dispatch_items(cells);
    auto fill = graph.compute("contour/fill grid", shaders::fill_grid_comp);
    fill.read(strokes.sizes).sample(strokes.samples);
    strokes.grid = fill.modify(strokes.grid);
    fill.push(size_px).dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
    const auto ask_strokes = [&](const char* name, const gpu::Shader& shader) {
        auto pass = graph.compute(name, shader);
        pass.read(strokes.sizes).sample(strokes.samples).read(strokes.grid);
        pass.sample(strokes.strokes_before, gpu::Format::r32ui);
        strokes.strokes = pass.modify(strokes.strokes);
        pass.push(size_px).dispatch_indirect(strokes.sizes, indirect_offset(shared::list_strokes));
    };
    ask_strokes("contour/drop", shaders::drop_comp);
    ask_strokes("contour/ends", shaders::ends_comp);
    return strokes;
}

/// Lets strokes find what they were in the frame before.
gpu::BufferId add_recall(gpu::Graph& graph, ChainStrokes& strokes, LineHistory& history, glm::uvec2 size_px)
{
    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto recall = graph.compute("contour/recall", shaders::recall_comp);
    recall.read(strokes.sizes).sample(strokes.samples);
    recall.sample(strokes.strokes_before, gpu::Format::r32ui);
    strokes.strokes = recall.modify(strokes.strokes);
    recall.read(gpu::import_whole(graph, "grid before", history.before().grid));
    recall.read(gpu::import_whole(graph, "samples before", history.before().samples));
    const gpu::BufferId recalls = recall.write(
        graph.buffer("contour/recalls", list_of(sample_capacity(size_px), sizeof(shared::Recall))));
    recall
        .push(shared::RecallConstants{.clip_from_anchor_before = history.clip_from_anchor_before(),
                                      .width = size_px.x,
                                      .height = size_px.y})
        .dispatch_indirect(strokes.sizes, per_sample);
    auto elect = graph.compute("contour/elect", shaders::elect_comp);
    elect.read(strokes.sizes).sample(strokes.samples);
    elect.sample(strokes.strokes_before, gpu::Format::r32ui).read(recalls);
    strokes.strokes = elect.modify(strokes.strokes);
    elect.dispatch_indirect(strokes.sizes, per_sample);
    return recalls;
}

shared::ShapeConstants shape_constants(const ContourStyle& style, const ContourInputs& in)
{
    const float pixels_per_mm = style.drawn ? in.pixels_per_mm : 0.0F;
    return {.silhouette_px = style.outline_mm * pixels_per_mm,
            .border_px = style.outline_mm * pixels_per_mm,
            .boundary_px = style.boundary_mm * pixels_per_mm,
            .crease_px = style.crease_mm * pixels_per_mm,
            .marked_px = style.marked_mm * pixels_per_mm,
            .ridge_px = style.ridge_mm * pixels_per_mm,
            .valley_px = style.valley_mm * pixels_per_mm,
            .suggestive_px = style.suggestive_mm * pixels_per_mm,
            .taper_px = style.taper_mm * pixels_per_mm,
            .overshoot_px = style.overshoot_mm * pixels_per_mm,
            .wobble_px = style.wobble_mm * pixels_per_mm,
            .pressure = style.pressure,
            .distance_thinning = style.distance_thinning,
            .seed = static_cast<uint32_t>(style.seed)};
}

/// Where the pen goes and how wide it draws, two LinePoints a sample.
gpu::BufferId add_shape(gpu::Graph& graph, const ContourInputs& in, const ChainInputs& lines,
                        const Chains& chains, ChainStrokes& strokes, LineHistory* history,
                        const ContourStyle& style)
{
    const bool recalls_frame = history != nullptr && history->holds_frame();
    const uint32_t samples_most = chains.constants.sample_capacity;
    const gpu::BufferId recalls =
        recalls_frame ? add_recall(graph, strokes, *history, in.size_px) : strokes.strokes_before;
    auto shape = graph.compute("contour/shape", shaders::shape_comp);
    shape.uniform(in.frame).read(strokes.sizes).sample(strokes.samples);
    shape.sample(strokes.strokes_before, gpu::Format::r32ui);
    shape.read(strokes.strokes).sample(lines.line_triangles).sample(lines.neighbors);
    shape.sample(chains.facing, gpu::Format::r32ui).sample(in.light).sample(in.draws).sample(in.materials);
    const gpu::BufferId line_points = shape.write(
        graph.buffer("contour/line points", list_of(2ULL * samples_most, sizeof(shared::LinePoint))));
    shape.read(recalls); // of no use where there is no frame before
    const gpu::BufferId remembered = shape.write(
        history != nullptr ? gpu::import_whole(graph, "samples now", history->now().samples)
                           : graph.buffer("contour/unremembered", list_of(1, sizeof(shared::DrawnSample))));
    static_cast<void>(remembered);
    shape.variant((in.own_outlines ? 1U : 0U) | (recalls_frame ? 2U : 0U) | (history != nullptr ? 4U : 0U))
        .push(shape_constants(style, in))
        .dispatch_indirect(strokes.sizes, indirect_offset(shared::list_samples));
    return line_points;
}

} // namespace

ChainStrokes add_strokes(gpu::Graph& graph, const ChainInputs& in, const Chains& chains, gpu::BufferId grid)
{
    const shared::ChainConstants& constants = chains.constants;
    const uint32_t slots_most = constants.segment_capacity + constants.feature_chain_count;
    const uint32_t samples_most = constants.sample_capacity;
    const Scanned lengths = add_scan(graph, "lengths",
                                     {.sizes = chains.sizes,
                                      .values = chains.lengths,
                                      .value_capacity = constants.point_capacity,
                                      .constants = scan_of(shared::list_points, shared::no_list, 0)});

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
                  .constants = scan_of(shared::list_slots, shared::list_samples, samples_most)});

    const uint64_t per_sample = indirect_offset(shared::list_samples);
    auto sample = graph.compute("contour/sample", shaders::sample_comp);
    sample.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices).read(in.visibility);
    sample.read(divided.sizes);
    for (const gpu::BufferId before : {divided.before, chains.points_before, lengths.before}) {
        sample.sample(before, gpu::Format::r32ui);
    }
    sample.sample(chains.points);
    const gpu::BufferId samples =
        sample.write(graph.buffer("contour/samples", list_of(samples_most, sizeof(shared::LineSample))));
    sample.push(constants).dispatch_indirect(divided.sizes, per_sample);

    auto settle = graph.compute("contour/settle", shaders::settle_comp);
    settle.read(divided.sizes).sample(divided.before, gpu::Format::r32ui);
    settle.read(chains.flags_of_slot).sample(samples);
    const gpu::BufferId states =
        settle.write(graph.buffer("contour/states", list_of(samples_most, sizeof(uint32_t))));
    const gpu::BufferId rotation = settle.modify(no_rotation);
    settle.dispatch_indirect(divided.sizes, per_sample);

    auto split = graph.compute("contour/split", shaders::split_comp);
    split.read(divided.sizes).sample(divided.before, gpu::Format::r32ui);
    split.read(chains.flags_of_slot).read(rotation);
    split.sample(samples).read(states);
    const gpu::BufferId cut =
        split.write(graph.buffer("contour/cut samples", list_of(samples_most, sizeof(shared::LineSample))));
    const gpu::BufferId starts =
        split.write(graph.buffer("contour/starts", list_of(samples_most, sizeof(uint32_t))));
    split.dispatch_indirect(divided.sizes, per_sample);
    const Scanned started =
        add_scan(graph, "strokes",
                 {.sizes = divided.sizes,
                  .values = starts,
                  .value_capacity = samples_most,
                  .constants = scan_of(shared::list_samples, shared::list_strokes, samples_most)});

    auto bounds = graph.compute("contour/strokes", shaders::strokes_comp);
    bounds.read(started.sizes).sample(cut).sample(started.before, gpu::Format::r32ui);
    const gpu::BufferId strokes =
        bounds.write(graph.buffer("contour/strokes", list_of(samples_most, sizeof(shared::Stroke))));
    bounds.dispatch_indirect(started.sizes, per_sample);
    return find_ends(graph,
                     {.sizes = started.sizes,
                      .lengths_before = lengths.before,
                      .samples = cut,
                      .samples_before = divided.before,
                      .strokes_before = started.before,
                      .strokes = strokes,
                      .grid = grid},
                     in.size_px);
}

ShapedStrokes add_shaped_strokes(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                 LineHistory* history, const ContourStyle& style)
{
    const ChainInputs lines{.frame = in.frame,
                            .posed_vertices = in.posed_vertices,
                            .visibility = in.visibility,
                            .neighbors = gpu::import_whole(graph, "line neighbors", mesh.neighbors),
                            .line_triangles = gpu::import_whole(graph, "line triangles", mesh.triangles),
                            .suggestive_cut = {style.suggestive_growth, style.suggestive_deg},
                            .size_px = in.size_px};
    const Chains chains = add_chains(graph, lines, mesh, style.silhouettes == Silhouettes::edges);
    const gpu::BufferId grid =
        history != nullptr
            ? gpu::import_whole(graph, "grid now", history->now().grid)
            : graph.buffer("contour/grid", list_of(grid_cell_count(in.size_px), sizeof(glm::uvec2)));
    ChainStrokes strokes = add_strokes(graph, lines, chains, grid);
    const gpu::BufferId line_points = add_shape(graph, in, lines, chains, strokes, history, style);
    return {.strokes = strokes, .facing = chains.facing, .line_points = line_points};
}

gpu::ImageId add_chain_contours(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                                LineHistory* history, const ContourStyle& style,
                                std::optional<gpu::ImageId> under)
{
    const ShapedStrokes shaped = add_shaped_strokes(graph, in, mesh, history, style);
    const shared::InkConstants constants{
        .width = in.size_px.x, .height = in.size_px.y, .ink_color = style.ink};
    const Inked inked = add_ink(graph, shaped.strokes, shaped.line_points, constants);
    const gpu::ImageId below = under ? *under : add_blank_layer(graph, constants, in.on_processor);
    auto layer = graph.compute("contour/ink layer", shaders::ink_layer_comp);
    layer.read(inked.pixels).sample(in.materials).read(inked.tiles).variant(in.own_outlines ? 1U : 0U);
    const gpu::ImageId ink = layer.modify(below);
    layer.push(constants).dispatch_indirect(inked.tiles);
    return ink;
}

} // namespace estampe::contour
