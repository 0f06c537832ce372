// SPDX-License-Identifier: MIT
#pragma once

// Stripes a constant distance apart along a line field, continuous all over but for isolated branch points.

#include <array>
#include <vector>

#include "techniques/form/direction.hpp"

namespace estampe::form {

struct Stripes {
    std::vector<std::array<double, 3>> corners; ///< one a triangle: phase in periods
    std::vector<int32_t> branches; ///< one a triangle: lines that begin in it less those that end in it
};

/// Phases that grow by one for each `period` (in radii of the mesh) in the direction of the line field turned
/// by `turn_rad`. Where a triangle holds a branch point or a singularity of the field its phases fit its
/// neighbours' on two edges only. Phases of neighbouring triangles differ by a whole number, nearly
/// everywhere 0, and by a sign where the field cannot have the one sense all over. Cost: linear.
[[nodiscard]] Stripes find_stripes(const Mesh& mesh, const Directions& directions, double turn_rad,
                                   double period, uint32_t seed);

} // namespace estampe::form
