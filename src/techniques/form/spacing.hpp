// SPDX-License-Identifier: MIT
#pragma once

// How close together stripes have to be here and there so that hardly any has to begin or end.

#include <vector>

#include "techniques/form/direction.hpp"

namespace estampe::form {

/// For each vertex, how many times closer than on average stripes lie that grow in the direction of the line
/// field turned by `turn_rad`: 1/4 to 4. Where their lines converge they close up, and a drawing that thins
/// out its strokes as they crowd has nothing to mend. Cost: linear.
[[nodiscard]] std::vector<double> find_closeness(const Mesh& mesh, const Directions& directions,
                                                 double turn_rad);

} // namespace estampe::form
