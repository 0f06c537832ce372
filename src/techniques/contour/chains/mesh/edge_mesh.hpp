// SPDX-License-Identifier: MIT
#pragma once

// Edge mesh: triangles with the neighbours across their edges. The edge mesh is computed once per scene, so
// that contours are linked without a search.

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

/// Number of the side that runs from corner `corner` of `triangle` to the next corner.
constexpr uint32_t side_of(uint32_t triangle, uint32_t corner)
{
    return triangle << 2U | corner;
}

/// Input of an edge mesh: triangles, with one position and one normal per vertex.
struct TriangleSoup {
    /// The indices of three vertices, and a fourth value that is copied unchanged.
    std::span<const glm::uvec4> triangles;
    /// Position of each vertex in the scene's rest pose, in which the angles of folds are measured.
    std::span<const glm::vec3> positions;
    /// Positions and normals in the mesh's own space, before the mesh's node or joints transform the mesh.
    /// The mesh's own space decides which vertices are welded and which side of a surface is the front. So a
    /// mesh has the same lines however it is rotated, scaled or mirrored.
    std::span<const glm::vec3> mesh_positions;
    std::span<const glm::vec3> mesh_normals;
    /// For each triangle: the number of the triangle's body, or no_side if the triangle has no lines. Only
    /// triangles of one body can be neighbours.
    std::span<const uint32_t> bodies;
    std::span<const uint32_t> materials; ///< material of each triangle
    std::span<const uint8_t> edge_marks; ///< marks of each triangle's edges, see pose::MeshData; may be empty
};

enum class FeatureKind : uint8_t { border, boundary, crease };

/// Mark of an edge in the model file. `unsaid`: the file marks no edges of the mesh. `plain`: the file marks
/// some edges of the mesh, but not the edge in question.
enum class EdgeMark : uint8_t { unsaid, plain, marked };

/// An edge that may have a line from every point of view, for example a border or a fold.
struct FeatureEdge {
    uint32_t side = no_side;
    uint32_t other_side = no_side; ///< the adjacent side; no_side at a border
    /// Angle by which the surface folds at the edge; 180 if more than two triangles meet at the edge.
    float fold_deg = 0.0F;
    FeatureKind kind = FeatureKind::crease;
    EdgeMark mark = EdgeMark::unsaid;
    bool is_split = false; ///< the shading breaks at the edge, because both sides have different normals
};

/// Triangles with their neighbours. Vertices of one body at the same position count as one point, even if
/// their normals or texture coordinates differ. Duplicate triangles count once. Two vertices are at the same
/// position if their distance is less than `weld_tolerance` times the body's size, and less than a tenth of
/// the shortest edge at either vertex. Small gaps between vertices occur where a modelling tool computes a
/// seam twice, for example with the sine of 0 and of 2 pi.
struct EdgeMesh {
    /// For each triangle: three vertices, and the value copied from TriangleSoup. Of all vertices with equal
    /// position and normal, only the first is used.
    std::vector<glm::uvec4> triangles;
    /// For each triangle: the three adjacent sides and the triangle's flags, see chains.glsl.h.
    std::vector<glm::uvec4> neighbors;
    std::vector<uint32_t> points; ///< for each vertex: the first vertex at the same position
    /// All borders, boundaries and marked edges, and folds of more than `least_fold_deg`.
    std::vector<FeatureEdge> features;
    /// Each edge at which the shading breaks, as the edge's two triangle sides.
    std::vector<glm::uvec2> hard_edges;
    /// Number of shells (surfaces whose triangles are connected by edges).
    uint32_t shell_count = 0;
};

constexpr float least_fold_deg = 10.0F;

/// Largest distance between vertices that are welded, as a share of the diagonal of the body's bounding box.
constexpr float weld_tolerance = 1e-5F;

/// Finds the neighbours of all triangles and classifies the edges between them. Cost: linear; about 0.5 us
/// per triangle.
[[nodiscard]] EdgeMesh build_edge_mesh(const TriangleSoup& soup);

} // namespace estampe::contour
