// SPDX-License-Identifier: MIT
#pragma once

// A figure that walks and wears meshes that are bound to its chest.

#include <estampe/scene.hpp>

namespace kit {

struct Walker {
    estampe::Index skin = 0;
    uint16_t chest = 0; ///< index among the skin's joints
};

/// Adds a figure of 1.75 m that walks from `foot_m` along +z at 1.2 m/s and starts again after 4 s.
Walker add_walker(estampe::Scene& scene, glm::dvec3 foot_m);

/// Binds a primitive, given in the figure's object space, to one of the figure's joints.
void bind(estampe::Primitive& primitive, uint16_t joint);

} // namespace kit
