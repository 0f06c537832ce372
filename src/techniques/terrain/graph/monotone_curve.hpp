// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::terrain {

/// Points with the slopes of a smooth curve through them that rises and falls where they do and nowhere else
/// (Fritsch and Carlson, "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 1980), level at its
/// ends: x, y, slope one after the other. At least two points, from left to right.
[[nodiscard]] std::vector<double> monotone_curve(std::span<const glm::dvec2> points);

} // namespace estampe::terrain
