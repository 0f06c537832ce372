// SPDX-License-Identifier: MIT
#include "shaders/clear_grid_comp.hpp"
#include "shaders/drop_comp.hpp"
#include "shaders/ends_comp.hpp"
#include "shaders/fill_grid_comp.hpp"
#include "shaders/split_comp.hpp"
#include "shaders/strokes_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan/scan.hpp"
#include "techniques/contour/chains/variants.glsl.h"

namespace estampe::contour {
namespace {

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
                  .is_spread = in.execution.spreads_scans(),
                  .constants = scan_of_list(shared::list_samples, shared::list_strokes, samples_most)});

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
