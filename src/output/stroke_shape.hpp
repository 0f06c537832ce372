// SPDX-License-Identifier: MIT
#pragma once

// Strokes as SVG path data.

#include <string>

#include <estampe/vector_drawing.hpp>

namespace estampe::output {

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
