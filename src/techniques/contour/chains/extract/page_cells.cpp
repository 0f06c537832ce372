// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/extract/page_cells.hpp"

#include "gpu/transfers.hpp"
#include "shaders/cross_meetings_comp.hpp"
#include "shaders/cross_shadows_comp.hpp"
#include "shaders/emit_cells_comp.hpp"
#include "shaders/list_meetings_comp.hpp"
#include "shaders/mark_cells_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {
namespace {

/// Size of the page lattice (the grid in which lines are found on the page), in points.
glm::uvec2 lattice(glm::uvec2 size_px)
{
    return (size_px + (shared::cell_px - 1)) / shared::cell_px;
}

uint32_t point_count(glm::uvec2 size_px)
{
    return lattice(size_px).x * lattice(size_px).y;
}

shared::CellConstants cell_constants(glm::uvec2 size_px, uint32_t kind, uint32_t first_word,
                                     uint32_t word_count = 0)
{
    return {.columns = lattice(size_px).x,
            .rows = lattice(size_px).y,
            .first_word = first_word,
            .word_count = word_count,
            .kind = kind,
            .point_px = kind == shared::line_shadow ? 0.0F : 0.5F};
}

PageLines add_meetings(gpu::Graph& graph, const ChainInputs& in, uint32_t first_word)
{
    const shared::CellConstants constants = cell_constants(in.size_px, shared::line_intersection, first_word);
    const uint64_t points = point_count(in.size_px);
    const gpu::BufferId none =
        gpu::add_empty_list(graph, "contour/meetings", 16 + 2 * sizeof(uint32_t) * points);
    auto list = graph.compute("contour/list meetings", shaders::list_meetings_comp);
    list.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui).sample(in.neighbors);
    const gpu::BufferId meetings = list.modify(none);
    gpu::BufferId crossings =
        list.write(graph.buffer("contour/meeting crossings", list_of(points, sizeof(glm::uvec2))));
    list.push(constants).dispatch_over(constants.columns, constants.rows);

    auto cross = graph.compute("contour/cross meetings", shaders::cross_meetings_comp);
    cross.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
    cross.sample(in.visibility, gpu::Format::rg32ui).sample(in.neighbors);
    cross.read(meetings);
    crossings = cross.modify(crossings);
    cross.push(constants).dispatch_indirect(meetings);
    return {.crossings = crossings, .kind = shared::line_intersection, .first_word = first_word};
}

PageLines add_shadow_edges(gpu::Graph& graph, const ChainInputs& in, const SunPixels& sun,
                           uint32_t first_word)
{
    const shared::CellConstants constants = cell_constants(in.size_px, shared::line_shadow, first_word);
    auto cross = graph.compute("contour/cross shadows", shaders::cross_shadows_comp);
    cross.uniform(in.frame).sample(sun.share).sample(sun.draw).sample(sun.depth).sample(sun.normal);
    const gpu::BufferId crossings = cross.write(
        graph.buffer("contour/shadow crossings", list_of(point_count(in.size_px), sizeof(glm::uvec2))));
    cross.push(constants).dispatch_over(constants.columns, constants.rows);
    return {.crossings = crossings, .kind = shared::line_shadow, .first_word = first_word};
}

} // namespace

uint32_t page_words(glm::uvec2 size_px)
{
    return (point_count(size_px) + 31) / 32;
}

InlineVector<PageLines, 2> add_page_lines(gpu::Graph& graph, const ChainInputs& in, uint32_t first_word)
{
    InlineVector<PageLines, 2> lines;
    if (in.meetings) {
        lines.push_back(add_meetings(graph, in, first_word));
        first_word += page_words(in.size_px);
    }
    if (in.sun) {
        lines.push_back(add_shadow_edges(graph, in, *in.sun, first_word));
    }
    return lines;
}

gpu::BufferId add_cell_marks(gpu::Graph& graph, const PageLines& lines, glm::uvec2 size_px,
                             gpu::BufferId marks)
{
    auto mark = graph.compute("contour/mark cells", shaders::mark_cells_comp);
    mark.sample(lines.crossings, gpu::Format::rg32ui);
    const gpu::BufferId marked = mark.modify(marks);
    mark.push(cell_constants(size_px, lines.kind, lines.first_word));
    mark.dispatch((point_count(size_px) + 63) / 64);
    return marked;
}

void add_cell_segments(gpu::Graph& graph, const ChainInputs& in, const PageLines& lines, CellSegments& list)
{
    auto emit = graph.compute("contour/emit cells", shaders::emit_cells_comp);
    emit.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
    const bool of_shadows = lines.kind == shared::line_shadow;
    emit.sample(of_shadows ? in.sun->visibility : in.visibility, gpu::Format::rg32ui);
    emit.sample(lines.crossings, gpu::Format::rg32ui);
    emit.sample(list.marks, gpu::Format::r32ui).sample(list.marks_before, gpu::Format::r32ui);
    emit.read(list.sizes);
    list.segments = emit.modify(list.segments);
    list.ranks = emit.modify(list.ranks);
    emit.push(cell_constants(in.size_px, lines.kind, lines.first_word, list.word_count));
    emit.dispatch_indirect(list.sizes, indirect_offset(shared::list_segments));
}

} // namespace estampe::contour
