// SPDX-License-Identifier: MIT
#pragma once

// Lines that no mesh has edges for, found between the pixels of the page: where surfaces run into each other,
// and where shadows end.

#include <vector>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ChainInputs;

/// Where lines of one kind cross the sides of the page's lattice, as page_cells.glsl has it.
struct PageLines {
    gpu::BufferId crossings;
    uint32_t kind;
    uint32_t first_word; ///< of the marks of its cells
};

/// Words of marks of one kind of line.
[[nodiscard]] uint32_t page_words(glm::uvec2 size_px);

/// Finds lines of the kinds that `in` asks for. Their marks come one kind after the other from `first_word`
/// on.
///
/// Cost    one thread for each four pixels and kind; of meetings, one more where shells adjoin on the page
/// Source  cells: Lorensen and Cline, "Marching Cubes", 1987, in the plane
[[nodiscard]] InlineVector<PageLines, 2> add_page_lines(gpu::Graph& graph, const ChainInputs& in,
                                                        uint32_t first_word);

/// Marks the cells that `lines` run through.
[[nodiscard]] gpu::BufferId add_cell_marks(gpu::Graph& graph, const PageLines& lines, glm::uvec2 size_px,
                                           gpu::BufferId marks);

/// What segments of marked cells are made from, and where to.
struct CellSegments {
    gpu::BufferId marks;
    gpu::BufferId marks_before;
    gpu::BufferId sizes;
    gpu::BufferId segments;
    gpu::BufferId ranks;
    uint32_t word_count; ///< of all marks
};

/// Enters the segments of `lines` and their ranks among all others.
void add_cell_segments(gpu::Graph& graph, const ChainInputs& in, const PageLines& lines, CellSegments& list);

} // namespace estampe::contour
