// SPDX-License-Identifier: MIT
#pragma once

// A mesh prepared for field computations: welded, cleaned, cut along creases, with angles around each vertex.
// Also declares the fields on the mesh: the stroke direction (a smooth line field along the greatest
// curvature), and evenly spaced stripes along the stroke direction. The stripes are continuous except at
// isolated branch points.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/form/form.hpp"

namespace estampe::form {

constexpr uint32_t none = ~0U;

/// An edge of the mesh. The angles of the edge are in radians, each in the tangent plane of a vertex.
struct Edge {
    uint32_t from = 0;
    uint32_t to = 0;
    uint32_t half_edge = 0; ///< the half-edge that runs from `from` to `to`
    uint32_t twin = none;   ///< the half-edge from `to` to `from`, in the adjacent triangle
    double weight = 0.0; ///< half the sum of the cotangents of the two angles opposite to the edge, clamped
    double length = 0.0; ///< length in radii of the mesh
    double angle_at_from = 0.0; ///< angle at which the edge leaves `from`
    double angle_at_to = 0.0;   ///< angle at which the edge leaves `to`
};

/// Links two vertices at one position, one vertex on either side of a crease. A direction at the vertex
/// `from` that is rotated by `turn` has the same angle to the crease at the vertex `to`.
struct CreaseLink {
    uint32_t from = 0;
    uint32_t to = 0;
    double turn = 0.0;
    double angle_at_from = 0.0; ///< angle of the crease in the tangent plane of `from`
    double length = 0.0;        ///< length of the half of the crease edge next to the vertices
};

/// The triangles of a manifold surface with border. The surface is cut at creases sharper than 45 degrees, at
/// edges of more than two triangles, and between triangles of opposite orientation. Half-edge number 3 t + k
/// runs from corner number k of triangle number t to the next corner. Lengths are in radii of the mesh,
/// positions relative to the mesh's centre.
struct Mesh {
    std::vector<glm::dvec3> points; ///< position of each vertex
    std::vector<double> areas;      ///< for each vertex: the vertex's share of the surface's area
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> sources; ///< for each triangle: the triangle's index in the input
    /// For each half-edge: the half-edge in the adjacent triangle; `none` at a cut.
    std::vector<uint32_t> twins;
    std::vector<uint32_t> edge_of;     ///< for each half-edge: index of the half-edge's edge in `edges`
    std::vector<double> corner_angles; ///< for each half-edge: angle of the triangle at the half-edge's start
    /// For each vertex: ratio of an angle in the tangent plane to the angle on the surface.
    std::vector<double> angle_scales;
    /// For each half-edge: angle in the tangent plane of the half-edge's start.
    std::vector<double> half_edge_angles;
    std::vector<glm::dvec3> normals; ///< normal of each vertex
    std::vector<Edge> edges;
    std::vector<CreaseLink> crease_links;
    glm::dvec3 center_m{0.0};
    double radius_m = 1.0;
    uint32_t dropped_triangles = 0;
    uint32_t crease_edges = 0;

    /// The normal's length is twice the triangle's area.
    [[nodiscard]] glm::dvec3 triangle_normal(uint32_t triangle) const;
    /// Rotation from the plane of a triangle, where angles are measured from the triangle's first edge, to
    /// the tangent plane of one of the triangle's corners.
    [[nodiscard]] double vertex_from_triangle(uint32_t triangle, uint32_t corner) const;
};

/// Prepares a mesh. Cost: dominated by sorting the vertices and the edges.
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
    /// For each vertex: angle of the line in the vertex's tangent plane, in radians.
    std::vector<double> angles;
    std::vector<uint8_t>
        turns; ///< for each edge: 1 if the directions at the two ends point in opposite senses
    std::vector<uint8_t>
        link_turns; ///< for each crease link: 1 if the directions at the two ends point in opposite senses
};

/// Finds the angle of a line at each vertex, so that the line field is nearly as smooth as possible. The
/// chosen senses of the lines (one of two directions) change across few edges. `reach` is the distance over
/// which curvature is averaged, in radii of the mesh. Cost: linear.
[[nodiscard]] Directions find_directions(const Mesh& mesh, const glm::dvec3& up, double reach);

/// Index of the line field in a triangle: a multiple of 1/2. The triangle is singular if the index is not 0.
[[nodiscard]] double singularity(const Mesh& mesh, const Directions& directions, uint32_t triangle);

struct Stripes {
    /// For each corner of each triangle: phase of the stripes, in periods.
    std::vector<std::array<double, 3>> corners;
    /// For each triangle: number of lines that begin in the triangle, minus the number of lines that end
    /// there.
    std::vector<int32_t> branches;
};

/// Computes phases that grow by one per `period` (in radii of the mesh) in the direction of the line field
/// turned by `turn_rad`. In a triangle with a branch point or a singularity, the phases agree with the
/// neighbouring triangles across two edges only. Phases of neighbouring triangles differ by a whole number,
/// mostly 0. Phases of neighbouring triangles also differ in sign where the line field cannot have one sense
/// everywhere. Cost: linear.
[[nodiscard]] Stripes find_stripes(const Mesh& mesh, const Directions& directions, double turn_rad,
                                   double period, uint32_t seed);

} // namespace estampe::form
