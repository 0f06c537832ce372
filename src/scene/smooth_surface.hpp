// SPDX-License-Identifier: MIT
#pragma once

// The smooth surface that triangles stand for: how it bends, and triangles divided towards it.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// What differs from one end of a triangle's side to the other, along two axes of the triangle's plane.
struct SideChange {
    glm::dvec2 place;
    glm::dvec2 normal;
};

/// Second fundamental form xx, xy, yy of a triangle by least squares, in inverse units of the places;
/// positive on a ball. Zero where the determinant of the normal equations is not above `least_determinant`,
/// as a share of what it could be.
///
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] glm::dvec3 second_form(const std::array<SideChange, 3>& sides, double least_determinant);

/// The triangles of `primitive` divided into four, `levels` times, towards the smooth surface that they are
/// the cage of. Vertices at one place are one; borders stay; edges of more than two triangles count as
/// borders. The result has positions and smooth normals alone. Cost: linear in the triangles of the result.
///
/// Source  Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987
[[nodiscard]] Primitive subdivided(const Primitive& primitive, uint32_t levels);

} // namespace estampe
