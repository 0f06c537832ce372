// SPDX-License-Identifier: MIT
#pragma once

// Judges folds of a mesh by more than one edge, so that only folds of the shape get lines and not the folds
// of single triangles, which scans and decimated meshes are full of.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// The angle in degrees by which the surface folds at an edge with two sides. A triangle that is hardly more
/// than a line has a normal of any direction, so the triangle beyond it is taken instead. Cost: constant.
[[nodiscard]] float fold_beyond_slivers(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                                        const FeatureEdge& edge);

/// Whether an edge folds the surface only because facets stand for a round shape, for example a fillet or a
/// pillar of twelve sides. The fold of such an edge is at most 41 degrees, and among the eight triangles
/// around either facet the surface turns on in the same sense, together by at least half of the fold. Cost:
/// constant.
[[nodiscard]] bool is_between_facets(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                                     const FeatureEdge& edge);

/// An edge of a mesh that may get a line.
struct LineEdge {
    uint32_t side = no_side;
    uint32_t kind = 0; ///< shared::line_crease or another kind of line
    uint32_t from = 0; ///< vertex at the start of the edge; `to` is the vertex at the edge's end
    uint32_t to = 0;
};

/// Removes creases that come from nowhere and lead nowhere: lines of creases with a loose end that are
/// shorter than three usual edges of their shell and than 3 % of the shell's size, or that turn to and fro at
/// every vertex. What remains is looked at again, because a longer crease may have lost its branches. Other
/// kinds of lines stay. Cost: n log n in the number of edges; linear in the mesh if a crease has a loose end.
void leave_out_lone_creases(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                            std::vector<LineEdge>& edges);

} // namespace estampe::contour
