// SPDX-License-Identifier: MIT
#pragma once

// What lies on the other side of each edge, found once for a scene: contours link along it without a search.

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

/// What an edge mesh is made of; one position and normal per vertex.
struct TriangleSoup {
    std::span<const glm::uvec4> triangles; ///< three vertices, and what is handed through
    std::span<const glm::vec3> positions;  ///< in the rest pose of the scene: folds are measured here
    /// As the mesh itself has them, before its node or joints place it. Vertices are welded and the two sides
    /// of a surface told apart here, so that a mesh has the same lines however it is turned, scaled or
    /// mirrored.
    std::span<const glm::vec3> mesh_positions;
    std::span<const glm::vec3> mesh_normals;
    std::span<const uint32_t> bodies; ///< one a triangle: only triangles of one body share edges; no_side for
                                      ///< triangles that have no lines
    std::span<const uint32_t> materials; ///< one a triangle
    std::span<const uint8_t> edge_marks; ///< one a triangle, as pose::MeshData has them; or none at all
};

enum class FeatureKind : uint8_t { border, boundary, crease };

/// What the file says of an edge: `plain` where it says of the triangles at the edge that it is not marked.
enum class EdgeMark : uint8_t { unsaid, plain, marked };

/// An edge that may have a line from wherever it is seen.
struct FeatureEdge {
    uint32_t side = no_side;
    uint32_t other_side = no_side; ///< none for a border
    float fold_deg = 0.0F;         ///< how much the surface bends; 180 where more than two triangles meet
    FeatureKind kind = FeatureKind::crease;
    EdgeMark mark = EdgeMark::unsaid;
    bool is_split = false; ///< shading breaks here: the two sides have normals of their own
};

/// Triangles with their neighbours. Vertices at one place of one body are one point, whatever else differs
/// in them; triangles that are there twice count once. Two vertices are at one place when they miss each
/// other by less than `weld_tolerance` of the body's size and a tenth of the shortest edge at either: tools
/// that compute a seam twice, as by the sine of 0 and of 2 pi, leave such gaps.
struct EdgeMesh {
    /// Corners, of vertices that stand for all at their place with their normal, and what is handed through.
    std::vector<glm::uvec4> triangles;
    /// What each triangle has beyond its sides, see chains.glsl.h.
    std::vector<glm::uvec4> neighbors;
    std::vector<uint32_t> points; ///< one a vertex: the first vertex at its place
    std::vector<FeatureEdge>
        features; ///< borders, boundaries, what is marked, and all folds of more than `least_fold_deg`
    std::vector<glm::uvec2> hard_edges; ///< both sides of each edge that shading breaks at
    uint32_t shell_count = 0;           ///< pieces of surface that share no edge with each other
};

constexpr float least_fold_deg = 10.0F;

/// Share of a body's size, the diagonal of its box, within which vertices are welded.
constexpr float weld_tolerance = 1e-5F;

/// Cost: linear; about 0.5 us a triangle.
[[nodiscard]] EdgeMesh build_edge_mesh(const TriangleSoup& soup);

} // namespace estampe::contour
