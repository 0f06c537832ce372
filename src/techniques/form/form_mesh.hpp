// SPDX-License-Identifier: MIT
#pragma once

// A mesh made fit for fields: welded, cleaned, cut along creases, with angles about each vertex; and the
// fields over it: the direction of strokes, a smooth line field along the greatest curvature, and stripes a
// constant distance apart along it, continuous all over but for isolated branch points.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/form/form.hpp"

namespace estampe::form {

constexpr uint32_t none = ~0U;

/// Two vertices a unit apart in the graph of the mesh. Angles are in radians, in the tangent plane of a
/// vertex.
struct Edge {
    uint32_t from = 0;
    uint32_t to = 0;
    uint32_t half_edge = 0;     ///< from -> to
    uint32_t twin = none;       ///< to -> from, in the other triangle
    double weight = 0.0;        ///< half the sum of the cotangents, bounded
    double length = 0.0;        ///< in radii of the mesh
    double angle_at_from = 0.0; ///< of the edge, leaving `from`
    double angle_at_to = 0.0;   ///< of the edge, leaving `to`
};

/// Two vertices at the same place on either side of a crease. A direction that has the one angle to the
/// crease at `from` has it at `to` when turned by `turn`.
struct CreaseLink {
    uint32_t from = 0;
    uint32_t to = 0;
    double turn = 0.0;
    double angle_at_from = 0.0; ///< of the crease
    double length = 0.0;        ///< of the half of the crease that belongs to this end
};

/// Triangles of a surface that is a manifold with border: creases sharper than 45 degrees, edges of more than
/// two triangles and edges between triangles of contrary sense are cuts. Half-edge 3 t + k leads from corner
/// k of triangle t to the next. Lengths are in radii of the mesh, about its centre.
struct Mesh {
    std::vector<glm::dvec3> points; ///< one a vertex
    std::vector<double> areas;      ///< one a vertex: its share of the surface
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> sources;        ///< one a triangle: its place in the input
    std::vector<uint32_t> twins;          ///< one a half-edge; none at a cut
    std::vector<uint32_t> edge_of;        ///< one a half-edge: into `edges`
    std::vector<double> corner_angles;    ///< one a half-edge: inside the triangle, at its origin
    std::vector<double> angle_scales;     ///< one a vertex: tangent-plane angle over angle on the surface
    std::vector<double> half_edge_angles; ///< one a half-edge: in the tangent plane of its origin
    std::vector<glm::dvec3> normals;      ///< one a vertex
    std::vector<Edge> edges;
    std::vector<CreaseLink> crease_links;
    glm::dvec3 center_m{0.0};
    double radius_m = 1.0;
    uint32_t dropped_triangles = 0;
    uint32_t crease_edges = 0;

    [[nodiscard]] glm::dvec3 triangle_normal(uint32_t triangle) const; ///< length is twice the area
    /// Turn that takes an angle in the plane of a triangle, measured from its first edge, to the tangent
    /// plane of one of its corners.
    [[nodiscard]] double vertex_from_triangle(uint32_t triangle, uint32_t corner) const;
};

/// Cost: sorting the vertices and the edges.
[[nodiscard]] Mesh build_mesh(std::span<const glm::vec3> positions_m,
                              std::span<const uint32_t> triangle_indices);

inline uint32_t next_corner(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

inline uint32_t previous_corner(uint32_t half_edge)
{
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

struct Directions {
    std::vector<double> angles; ///< one a vertex: in its tangent plane, radians
    std::vector<uint8_t>
        turns; ///< one an edge: 1 where the angle at its end points the other way than at its start
    std::vector<uint8_t>
        link_turns; ///< one per link over a crease: 1 where the angles at its ends point opposite ways
};

/// Angles whose lines have nearly the least change; signs are such that few edges turn.
/// `reach` is how far the curvature of a place is heard, in radii of the mesh. Cost: linear.
[[nodiscard]] Directions find_directions(const Mesh& mesh, const glm::dvec3& up, double reach);

/// Index of the line field in a triangle: a multiple of 1/2, other than 0 where it is singular.
[[nodiscard]] double singularity(const Mesh& mesh, const Directions& directions, uint32_t triangle);

struct Stripes {
    std::vector<std::array<double, 3>> corners; ///< one a triangle: phase in periods
    std::vector<int32_t> branches; ///< one a triangle: lines that begin in it less those that end in it
};

/// Phases that grow by one for each `period` (in radii of the mesh) in the direction of the line field turned
/// by `turn_rad`. Where a triangle holds a branch point or a singularity of the field its phases fit its
/// neighbours' on two edges only. Phases of neighbouring triangles differ by a whole number, nearly
/// everywhere 0, and by a sign where the field cannot have the one sense all over. Cost: linear.
[[nodiscard]] Stripes find_stripes(const Mesh& mesh, const Directions& directions, double turn_rad,
                                   double period, uint32_t seed);

} // namespace estampe::form
