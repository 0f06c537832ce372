// SPDX-License-Identifier: MIT
#pragma once

// A figure that walks, and wears what is bound to its chest.

#include <estampe/scene.hpp>

namespace kit {

struct Walker {
    estampe::Index skin = 0;
    uint16_t chest = 0; ///< among the skin's joints
};

/// Adds a figure of 1.75 m that walks along +z from `foot_m` on, 1.2 m/s, and begins anew after 4 s.
Walker add_walker(estampe::Scene& scene, glm::dvec3 foot_m);

/// Binds a primitive, in the figure's own space, to one of its joints.
void bind(estampe::Primitive& primitive, uint16_t joint);

} // namespace kit
