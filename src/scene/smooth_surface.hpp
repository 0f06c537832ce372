// SPDX-License-Identifier: MIT
#pragma once

// The smooth surface that triangles approximate: its curvature, and subdivision of triangles towards it.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// Differences of position and normal between the ends of a triangle's side, along two axes of the triangle's
/// plane.
struct SideChange {
    glm::dvec2 place;
    glm::dvec2 normal;
};

/// Second fundamental form xx, xy, yy of a triangle by least squares, in inverse units of the positions;
/// positive on a sphere. Zero if the determinant of the normal equations, relative to its largest possible
/// value, is not above `least_determinant`.
///
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] glm::dvec3 second_form(const std::array<SideChange, 3>& sides, double least_determinant);

/// Subdivides the triangles of `primitive`, each into four, `levels` times, towards their smooth limit
/// surface. Vertices at one position count as one vertex. Borders keep their shape; edges of more than two
/// triangles count as borders. The result has only positions and smooth normals. Cost: linear in the
/// triangles of the result.
///
/// Source  Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987
[[nodiscard]] Primitive subdivided(const Primitive& primitive, uint32_t levels);

} // namespace estampe
