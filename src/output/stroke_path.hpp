// SPDX-License-Identifier: MIT
#pragma once

// Strokes as SVG path data: smooth curves through their points, their middle and their area.

#include <array>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/vector_drawing.hpp>

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

/// Whether one width will do for a whole stroke: none of its points strays from the middle one by more.
[[nodiscard]] bool has_one_width(const VectorStroke& stroke, float tolerance_mm);

/// The mean width over the length of a stroke.
[[nodiscard]] float mean_width_mm(const VectorStroke& stroke);

/// The middle of a stroke as path data in millimetres: "M1,2c...".
[[nodiscard]] std::string center_path(const VectorStroke& stroke, double tolerance_mm);

/// The area of a stroke, to be filled by the nonzero rule: its two sides, with round ends. What lies between
/// two corners is a shape of its own, so that corners are round.
[[nodiscard]] std::string area_path(const VectorStroke& stroke, double tolerance_mm);

/// A number of millimetres with no more digits than it needs, to a thousandth.
[[nodiscard]] std::string number(double value);

} // namespace estampe::output
