// SPDX-License-Identifier: MIT
#pragma once

// The direction of strokes: a smooth line field along the greatest curvature.

#include <vector>

#include "techniques/form/form.hpp"
#include "techniques/form/form_mesh.hpp"

namespace estampe::form {

struct Directions {
    std::vector<double> angles; ///< one a vertex: in its tangent plane, radians
    std::vector<uint8_t>
        turns; ///< one an edge: 1 where the angle at its end points the other way than at its start
    std::vector<uint8_t> link_turns; ///< the same for each link over a crease
};

/// Angles whose lines have nearly the least change; signs are such that few edges turn.
/// `reach` is how far the curvature of a place is heard, in radii of the mesh. Cost: linear.
[[nodiscard]] Directions find_directions(const Mesh& mesh, const glm::dvec3& up, double reach);

/// Index of the line field in a triangle: a multiple of 1/2, other than 0 where it is singular.
[[nodiscard]] double singularity(const Mesh& mesh, const Directions& directions, uint32_t triangle);

} // namespace estampe::form
