// SPDX-License-Identifier: MIT
#pragma once

// Lines that follow no edge of a mesh, found between the pixels of the page: where surfaces intersect, and
// where shadows end.

#include <vector>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ChainInputs;

/// Crossings of lines of one kind with the sides of the page's lattice, see page_cells.glsl.
struct PageLines {
    gpu::BufferId crossings;
    uint32_t kind;
    uint32_t first_word; ///< first word of the marks of its cells
};

/// Number of words of marks for one kind of line.
[[nodiscard]] uint32_t page_words(glm::uvec2 size_px);

/// Finds lines of the kinds that `in` asks for. Their marks follow each other, kind by kind, from
/// `first_word` on.
///
/// Cost    one thread for each four pixels and kind; for intersections, one more where shells adjoin on the
/// page
/// Source  cells: Lorensen and Cline, "Marching Cubes", 1987, in the plane
[[nodiscard]] InlineVector<PageLines, 2> add_page_lines(gpu::Graph& graph, const ChainInputs& in,
                                                        uint32_t first_word);

/// Marks the cells that `lines` run through.
[[nodiscard]] gpu::BufferId add_cell_marks(gpu::Graph& graph, const PageLines& lines, glm::uvec2 size_px,
                                           gpu::BufferId marks);

/// Buffers for turning marked cells into segments.
struct CellSegments {
    gpu::BufferId marks;
    gpu::BufferId marks_before;
    gpu::BufferId sizes;
    gpu::BufferId segments;
    gpu::BufferId ranks;
    uint32_t word_count; ///< number of words in `marks`
};

/// Appends the segments of `lines` and their ranks to the lists.
void add_cell_segments(gpu::Graph& graph, const ChainInputs& in, const PageLines& lines, CellSegments& list);

} // namespace estampe::contour
