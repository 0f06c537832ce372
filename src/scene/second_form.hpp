// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <glm/glm.hpp>

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

} // namespace estampe
