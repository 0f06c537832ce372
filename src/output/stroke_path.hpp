// SPDX-License-Identifier: MIT
#pragma once

// Strokes as SVG path data: smooth curves through their points, as centre lines or as outlines.

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

/// Fits a chain of cubic curves to `points`, from the first to the last. The curves stay within `tolerance`
/// of the points. A turn of more than 50 degrees at one point stays a corner. Elsewhere the tangent is
/// continuous, also across the seam of a closed line. Coincident points count once. Empty for fewer than two
/// distinct points.
///
/// Cost    usually n log n in points
/// Source  Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990
[[nodiscard]] std::vector<Cubic> fit_curve(std::span<const glm::dvec2> points, double tolerance,
                                           bool is_closed = false);

/// Splits a line at its corners: returns the indices of the first point, the corners and the last point.
[[nodiscard]] std::vector<size_t> corners_of(std::span<const glm::dvec2> points);

/// Returns whether a stroke can be drawn with one width: no point differs from the mean width by more than
/// the tolerance.
[[nodiscard]] bool has_one_width(const VectorStroke& stroke, float tolerance_mm);

/// Mean width of a stroke, weighted by length.
[[nodiscard]] float mean_width_mm(const VectorStroke& stroke);

/// Centre line of a stroke as path data in millimetres: "M1,2c...".
[[nodiscard]] std::string center_path(const VectorStroke& stroke, double tolerance_mm);

/// Outline of a stroke as path data, with round ends, for the nonzero fill rule. Each part between two
/// corners is a separate shape, so that corners are round.
[[nodiscard]] std::string area_path(const VectorStroke& stroke, double tolerance_mm);

/// Formats millimetres to a thousandth, without trailing zeros.
[[nodiscard]] std::string number(double value);

} // namespace estampe::output
