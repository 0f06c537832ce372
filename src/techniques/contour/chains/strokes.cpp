// SPDX-License-Identifier: MIT
#include "shaders/clear_grid_comp.hpp"
#include "shaders/divide_comp.hpp"
#include "shaders/drop_comp.hpp"
#include "shaders/ends_comp.hpp"
#include "shaders/fill_grid_comp.hpp"
#include "shaders/sample_comp.hpp"
#include "shaders/settle_comp.hpp"
#include "shaders/split_comp.hpp"
#include "shaders/strokes_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan.hpp"
#include "techniques/contour/chains/variants.glsl.h"

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

} // namespace

ChainSamples add_samples(gpu::Graph& graph, const ChainInputs& in, const Chains& chains)
{
    const shared::ChainConstants& constants = chains.constants;
    const uint32_t slots_most = constants.segment_capacity + constants.feature_chain_count;
    const uint32_t samples_most = constants.sample_capacity;
    const Scanned lengths = add_scan(graph, "lengths",
                                     {.sizes = chains.sizes,
                                      .values = chains.lengths,
                                      .value_capacity = constants.point_capacity,
                                      .is_spread = !in.on_processor,
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
                  .is_spread = !in.on_processor,
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

    return {.sizes = divided.sizes,
            .lengths_before = lengths.before,
            .samples_before = divided.before,
            .flags_of_slot = chains.flags_of_slot,
            .samples = samples,
            .states = states,
            .rotation = rotation,
            .on_processor = in.on_processor};
}

ChainStrokes add_strokes(gpu::Graph& graph, const ChainSamples& in, gpu::BufferId grid, glm::uvec2 size_px,
                         LineClass wanted)
{
    const uint32_t samples_most = sample_capacity(size_px);
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
                  .is_spread = !in.on_processor,
                  .constants = scan_of(shared::list_samples, shared::list_strokes, samples_most)});

    auto bounds = graph.compute("contour/strokes", shaders::strokes_comp);
    bounds.read(started.sizes).sample(cut).sample(started.before, gpu::Format::r32ui);
    const gpu::BufferId strokes =
        bounds.write(graph.buffer("contour/strokes", list_of(samples_most, sizeof(shared::Stroke))));
    bounds.dispatch_indirect(started.sizes, per_sample);
    return find_ends(graph,
                     {.sizes = started.sizes,
                      .samples = cut,
                      .samples_before = in.samples_before,
                      .strokes_before = started.before,
                      .strokes = strokes,
                      .grid = grid},
                     size_px);
}

} // namespace estampe::contour
