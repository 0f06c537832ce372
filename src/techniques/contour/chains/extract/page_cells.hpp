// SPDX-License-Identifier: MIT
#pragma once

// Lines that follow no edge of a mesh. Such lines are found between the pixels of the page: where surfaces
// intersect, where shadows end, and around clumps of leaves.

#include <optional>
#include <vector>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

struct ChainInputs;

/// Where the lines of one kind cross the sides of the page lattice (a grid of points on the page), see
/// page_cells.glsl.
struct PageLines {
    gpu::BufferId crossings;
    uint32_t kind;
    /// Index of the first word of mark bits (1: a line runs through) for the cells through which the lines
    /// run.
    uint32_t first_word;
    /// For lines around clumps: what the lattice shows, see foliage.glsl.
    std::optional<gpu::BufferId> foliage;
};

/// Largest number of kinds of lines that are found between the pixels of the page.
inline constexpr size_t most_page_lines = 3;

/// Number of words of mark bits (1: a line runs through) that one kind of line needs on a page of `size_px`.
[[nodiscard]] uint32_t page_words(glm::uvec2 size_px);

/// Finds lines of the kinds that `in` requests. The lines' mark bits (1: a line runs through) are stored kind
/// after kind, from word `first_word` on.
///
/// Cost    one thread for four pixels, per kind of line; for intersections, one more thread where two shells
/// (connected surfaces) adjoin on the page; for clumps, some fifteen passes of one thread for four pixels
/// Sources Lorensen and Cline, "Marching Cubes", 1987 (cells, in the plane);
///         Serra, "Image Analysis and Mathematical Morphology", 1982 (clumps)
[[nodiscard]] InlineVector<PageLines, most_page_lines>
add_page_lines(gpu::Graph& graph, const ChainInputs& in, uint32_t first_word);

/// Writes the mark bits (1: a line runs through) of the cells through which `lines` run.
[[nodiscard]] gpu::BufferId add_cell_marks(gpu::Graph& graph, const PageLines& lines, glm::uvec2 size_px,
                                           gpu::BufferId marks);

/// Buffers that are needed to convert marked cells of the page lattice (a grid of points on the page) to line
/// segments.
struct CellSegments {
    gpu::BufferId marks;
    gpu::BufferId marks_before;
    gpu::BufferId sizes;
    gpu::BufferId segments;
    gpu::BufferId ranks;
    uint32_t word_count; ///< number of words of mark bits (1: a line runs through) in `marks`
};

/// Appends the segments of `lines` to the list of segments, and the segments' ranks (states of pointer
/// jumping) to the list of ranks.
void add_cell_segments(gpu::Graph& graph, const ChainInputs& in, const PageLines& lines, CellSegments& list);

} // namespace estampe::contour
