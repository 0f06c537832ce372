// SPDX-License-Identifier: MIT
#pragma once

// A mesh prepared for field computations: welded, cleaned, cut along creases, with angles around each vertex.
// Also the fields themselves: the stroke direction, a smooth line field along the greatest curvature, and
// evenly spaced stripes along it, continuous except at isolated branch points.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/form/form.hpp"

namespace estampe::form {

constexpr uint32_t none = ~0U;

/// An edge of the mesh. Angles are in radians, in the tangent plane of a vertex.
struct Edge {
    uint32_t from = 0;
    uint32_t to = 0;
    uint32_t half_edge = 0;     ///< half-edge from -> to
    uint32_t twin = none;       ///< half-edge to -> from in the other triangle
    double weight = 0.0;        ///< half the sum of the cotangents, clamped
    double length = 0.0;        ///< in radii of the mesh
    double angle_at_from = 0.0; ///< angle of the edge leaving `from`
    double angle_at_to = 0.0;   ///< angle of the edge leaving `to`
};

/// Two vertices at the same place on either side of a crease. A direction at `from`, turned by `turn`, has
/// the same angle to the crease at `to`.
struct CreaseLink {
    uint32_t from = 0;
    uint32_t to = 0;
    double turn = 0.0;
    double angle_at_from = 0.0; ///< angle of the crease
    double length = 0.0;        ///< length of the half of the crease at this end
};

/// Triangles of a manifold surface with border: creases sharper than 45 degrees, edges of more than two
/// triangles, and edges between triangles of opposite orientation are cuts. Half-edge 3 t + k leads from
/// corner k of triangle t to the next corner. Lengths are in radii of the mesh, relative to its centre.
struct Mesh {
    std::vector<glm::dvec3> points; ///< per vertex
    std::vector<double> areas;      ///< per vertex: its share of the surface
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> sources;        ///< per triangle: its index in the input
    std::vector<uint32_t> twins;          ///< per half-edge; `none` at a cut
    std::vector<uint32_t> edge_of;        ///< per half-edge: index into `edges`
    std::vector<double> corner_angles;    ///< per half-edge: angle inside the triangle, at its origin
    std::vector<double> angle_scales;     ///< per vertex: tangent-plane angle over angle on the surface
    std::vector<double> half_edge_angles; ///< per half-edge: angle in the tangent plane of its origin
    std::vector<glm::dvec3> normals;      ///< per vertex
    std::vector<Edge> edges;
    std::vector<CreaseLink> crease_links;
    glm::dvec3 center_m{0.0};
    double radius_m = 1.0;
    uint32_t dropped_triangles = 0;
    uint32_t crease_edges = 0;

    [[nodiscard]] glm::dvec3 triangle_normal(uint32_t triangle) const; ///< length is twice the area
    /// Rotation that takes an angle in a triangle's plane, measured from its first edge, to the tangent plane
    /// of one of its corners.
    [[nodiscard]] double vertex_from_triangle(uint32_t triangle, uint32_t corner) const;
};

/// Cost: dominated by sorting the vertices and the edges.
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
    std::vector<double> angles; ///< per vertex: angle in its tangent plane, radians
    std::vector<uint8_t>
        turns; ///< per edge: 1 if the angle at its end points in the opposite sense to that at its start
    std::vector<uint8_t>
        link_turns; ///< per crease link: 1 if the angles at its ends point in opposite senses
};

/// Finds angles whose line field is nearly as smooth as possible, with senses that turn over few edges.
/// `reach` is the distance over which curvature has influence, in radii of the mesh. Cost: linear.
[[nodiscard]] Directions find_directions(const Mesh& mesh, const glm::dvec3& up, double reach);

/// Index of the line field in a triangle: a multiple of 1/2; not 0 if the triangle is singular.
[[nodiscard]] double singularity(const Mesh& mesh, const Directions& directions, uint32_t triangle);

struct Stripes {
    std::vector<std::array<double, 3>> corners; ///< per triangle: phases in periods
    std::vector<int32_t> branches; ///< per triangle: number of lines that begin in it minus lines that end
};

/// Computes phases that grow by one per `period` (in radii of the mesh) in the direction of the line field
/// turned by `turn_rad`. In a triangle with a branch point or a singularity, phases fit the neighbours on two
/// edges only. Phases of neighbouring triangles differ by a whole number, mostly 0, and by a sign where the
/// field cannot have one sense everywhere. Cost: linear.
[[nodiscard]] Stripes find_stripes(const Mesh& mesh, const Directions& directions, double turn_rad,
                                   double period, uint32_t seed);

} // namespace estampe::form
