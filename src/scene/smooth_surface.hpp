// SPDX-License-Identifier: MIT
#pragma once

// Estimates the curvature of the smooth surface that triangles approximate, and subdivides triangles towards
// this surface.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// Change of position and of normal from one end of a triangle's side to the other, along two axes of the
/// plane of the triangle.
struct SideChange {
    glm::dvec2 place;
    glm::dvec2 normal;
};

/// Returns the second fundamental form (curvature; xx, xy, yy) of a triangle by least squares, in inverse
/// units of the positions. The form is positive on a sphere. The form is zero if the determinant of the
/// normal equations is too small: at most `least_determinant` times the largest possible value.
///
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] glm::dvec3 second_form(const std::array<SideChange, 3>& sides, double least_determinant);

/// Subdivides each triangle of `primitive` into four, `levels` times, towards the smooth limit surface.
/// Vertices at equal positions count as one vertex. Border edges are smoothed only along the border; edges of
/// more than two triangles count as borders. The result has only positions and smooth normals. Cost: linear
/// in the triangles of the result.
///
/// Source  Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987
[[nodiscard]] Primitive subdivided(const Primitive& primitive, uint32_t levels);

} // namespace estampe
