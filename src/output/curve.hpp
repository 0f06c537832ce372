// SPDX-License-Identifier: MIT
#pragma once

// Smooth curves through points.

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::output {

/// Four control points of a cubic Bezier curve.
using Cubic = std::array<glm::dvec2, 4>;

[[nodiscard]] glm::dvec2 point_on(const Cubic& curve, double t);

/// Cubics, end to end, that pass by each of `points` no farther away than `tolerance`, from the first to the
/// last. Where the line turns by more than 50 degrees at one point a corner stays; elsewhere the direction
/// does not break, and over the seam of a closed line neither. Points that fall together count once. Nothing
/// for fewer than two places.
///
/// Cost    n log n in points, as a rule
/// Source  Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990
[[nodiscard]] std::vector<Cubic> fit_curve(std::span<const glm::dvec2> points, double tolerance,
                                           bool is_closed = false);

/// Where a line turns too sharply to be smooth: indices of its first point, its corners and its last point.
[[nodiscard]] std::vector<size_t> corners_of(std::span<const glm::dvec2> points);

} // namespace estampe::output
