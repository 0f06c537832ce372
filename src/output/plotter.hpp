// SPDX-License-Identifier: MIT
#pragma once

// Prepares drawings for pen plotters: removes strokes that need not be drawn, and cuts hidden strokes into
// dashes.

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Removes strokes and parts of strokes that repeat an earlier stroke of the same ink. A part of a stroke
/// repeats an earlier stroke if it runs in the direction of the earlier stroke, at a distance of less than a
/// third of its width. If only a part of a stroke is removed, the stroke is split. Crossing strokes stay
/// complete. Cost: linear in points.
void remove_overlaps(VectorDrawing& drawing);

/// Joins strokes of the same ink whose ends continue each other: lines over a gap below the width of the pen,
/// and hatching over a gap below twice this width. The pen draws over the gap. A line shorter than a
/// millimetre is also joined to a line that it touches at a corner. Dashes of hidden lines stay apart. Cost:
/// linear in strokes.
void join_strokes(VectorDrawing& drawing);

/// Removes strokes shorter than a millimetre: all of them in hatching, and those lines that have another line
/// beside them, within 1.5 mm. A short line that stands alone is kept, because it is the only mark of
/// something small, such as an eye. Dashes of hidden lines stay. Cost: linear in points.
void remove_scraps(VectorDrawing& drawing);

/// Cuts hidden strokes into dashes.
void cut_dashes(VectorDrawing& drawing);

/// Removes the parts of hatching that are thinner than half its usual width.
void remove_thin_hatching(VectorDrawing& drawing);

} // namespace estampe::output
