// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

/// Leaves out what runs along a stroke of the same ink before it: strokes that are there twice, and stretches
/// of strokes that lie within a third of their width of another and run its way. Strokes may fall apart.
/// Lines that cross stay whole. Cost: linear in points.
void remove_overlaps(VectorDrawing& drawing);

/// Cuts hidden strokes into dashes.
void cut_dashes(VectorDrawing& drawing);

/// Leaves out where hatching is thinner than half its usual width.
void remove_thin_hatching(VectorDrawing& drawing);

/// The stretches of `stroke` whose points are kept, as strokes of their own; lone points are lost.
[[nodiscard]] std::vector<VectorStroke> kept_stretches(const VectorStroke& stroke,
                                                       const std::vector<bool>& is_kept);

} // namespace estampe::output
