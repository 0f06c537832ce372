// SPDX-License-Identifier: MIT
#pragma once

// Adjacency of triangles across edges, computed once per scene, so that contours are linked without a search.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

using shared::neighbor_is_inside_out;
using shared::neighbor_is_turned;
using shared::neighbor_shell_shift;
using shared::neighbor_smooth_shift;
using shared::no_side;

/// The edge from corner `corner` of `triangle` to the next.
constexpr uint32_t side_of(uint32_t triangle, uint32_t corner)
{
    return triangle << 2U | corner;
}

/// Input of an edge mesh, with one position and normal per vertex.
struct TriangleSoup {
    std::span<const glm::uvec4> triangles; ///< three vertices, and a value that is passed through
    std::span<const glm::vec3> positions;  ///< in the rest pose of the scene; folds are measured here
    /// Positions and normals in the mesh's own space, before its node or joints transform it. Vertices are
    /// welded and the two sides of a surface are told apart in this space, so that a mesh has the same lines
    /// however it is rotated, scaled or mirrored.
    std::span<const glm::vec3> mesh_positions;
    std::span<const glm::vec3> mesh_normals;
    /// One per triangle: its body, because only triangles of one body share edges; no_side if it has no
    /// lines.
    std::span<const uint32_t> bodies;
    std::span<const uint32_t> materials; ///< one per triangle
    std::span<const uint8_t> edge_marks; ///< one per triangle, see pose::MeshData; or empty
};

enum class FeatureKind : uint8_t { border, boundary, crease };

/// Mark of an edge in the file; `plain` if the file gives marks at this edge but none is set.
enum class EdgeMark : uint8_t { unsaid, plain, marked };

/// An edge that may have a line in any view.
struct FeatureEdge {
    uint32_t side = no_side;
    uint32_t other_side = no_side; ///< no_side for a border
    float fold_deg = 0.0F;         ///< angle by which the surface folds; 180 if more than two triangles meet
    FeatureKind kind = FeatureKind::crease;
    EdgeMark mark = EdgeMark::unsaid;
    bool is_split = false; ///< the shading breaks here, because the two sides have different normals
};

/// Triangles with their neighbours. Vertices of one body at the same position are one point, whatever their
/// other attributes; duplicate triangles count once. Two vertices are at the same position if their distance
/// is less than `weld_tolerance` times the body's size and a tenth of the shortest edge at either. Tools that
/// compute a seam twice, for example with the sine of 0 and of 2 pi, leave such gaps.
struct EdgeMesh {
    /// Corners, and the value passed through. A corner is the vertex that represents all with its position
    /// and normal.
    std::vector<glm::uvec4> triangles;
    /// Adjacent sides and flags of each triangle, see chains.glsl.h.
    std::vector<glm::uvec4> neighbors;
    std::vector<uint32_t> points; ///< one per vertex: the first vertex at its position
    std::vector<FeatureEdge>
        features; ///< borders, boundaries, marked edges, and all folds of more than `least_fold_deg`
    std::vector<glm::uvec2> hard_edges; ///< both sides of each edge at which the shading breaks
    uint32_t shell_count = 0;           ///< pieces of surface that share no edge with each other
};

constexpr float least_fold_deg = 10.0F;

/// Distance within which vertices are welded, as a share of the body's size (the diagonal of its bounding
/// box).
constexpr float weld_tolerance = 1e-5F;

/// Cost: linear; about 0.5 us per triangle.
[[nodiscard]] EdgeMesh build_edge_mesh(const TriangleSoup& soup);

} // namespace estampe::contour
