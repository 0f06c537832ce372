// SPDX-License-Identifier: MIT
#pragma once

// Suggestive contours: where a surface would turn away if the eye moved a little.

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/bending.hpp"

namespace estampe::contour {

/// What makes a line of a place where the radial curvature is zero.
struct SuggestiveCut {
    float least_growth = 15.0F;    ///< of curvature towards the eye, both in inverse sizes of the object
    float least_angle_deg = 20.0F; ///< between the normal and the way to the eye
};

/// Bendings in the form of the shaders, in sizes of the object, each in a frame that hangs on a neighbour.
[[nodiscard]] std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                                 std::span<const Bending> bendings);

/// What the view makes of each vertex: radial curvature, and the strength of a line where that is zero.
///
/// Cost    one thread a vertex
/// Source  DeCarlo, Finkelstein, Rusinkiewicz and Santella, "Suggestive Contours for Conveying Shape", 2003
[[nodiscard]] gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame,
                                           gpu::BufferId posed_vertices, gpu::BufferId bendings,
                                           uint32_t vertex_count, const SuggestiveCut& cut);

} // namespace estampe::contour
