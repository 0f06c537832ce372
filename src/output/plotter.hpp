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

/// Removes hatching that would clog a narrow place: parts of a millimetre or more that run between two
/// strokes of the same ink, each at a distance of at most 0.8 pen widths. The paper between the two strokes
/// is then narrower than the pen. Lines and crossing strokes stay. Cost: linear in points.
void thin_hatching(VectorDrawing& drawing);

/// Joins strokes of the same ink if one stroke continues the other. Two lines are joined over a gap of at
/// most the width of the pen, and two hatching strokes over a gap of at most two widths of the pen. The
/// joined stroke crosses the gap. A line shorter than a millimetre is also joined to a line that touches it
/// at a corner. Dashes of hidden lines stay apart. Cost: linear in strokes.
void join_strokes(VectorDrawing& drawing);

/// Removes strokes shorter than a millimetre: hatching strokes, and lines within 1.5 mm of another line. A
/// short line that stands alone is kept, because the line may be the only mark of something small, such as an
/// eye. Dashes of hidden lines stay. Cost: linear in points.
void remove_scraps(VectorDrawing& drawing);

/// Cuts hidden strokes into dashes.
void cut_dashes(VectorDrawing& drawing);

/// Removes the parts of hatching that are thinner than half its usual width.
void remove_thin_hatching(VectorDrawing& drawing);

} // namespace estampe::output
