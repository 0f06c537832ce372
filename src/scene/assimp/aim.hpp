// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// Which way is up for what looks at a target: towards `node` if there is one, else `direction`, in the
/// world's axes.
struct Upward {
    glm::dvec3 direction{0.0, 1.0, 0.0};
    Index node = no_index;
    double roll_rad = 0.0; ///< about the line of sight
};

/// Turns the node `looking` so that its -z points at the origin of the node `target`, at rest, and in every
/// animation that moves either. A node that stands on its target stays as it is.
void aim_node(Scene& scene, Index looking, Index target, const Upward& upward);

} // namespace estampe
