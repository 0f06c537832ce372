// SPDX-License-Identifier: MIT
#pragma once

// What leaves a lamp or spot, and what comes of it: light/local_light.glsl for the processor.

#include <estampe/scene.hpp>

namespace estampe {

/// What a spot lights, by the angular falloff of KHR_lights_punctual.
struct SpotBeam {
    SpotShape shape = SpotShape::cone;
    glm::vec3 direction{0.0F, -1.0F, 0.0F}; ///< unit
    glm::vec3 side{1.0F, 0.0F, 0.0F}; ///< pyramids: unit, square to the beam, across two of the four sides
    float cone_scale = 1.0F;          ///< saturate(cos(angle) * scale + offset) squared
    float cone_offset = 0.0F;
};

/// The share of its light that a spot sends along a unit vector.
[[nodiscard]] float share_along(const SpotBeam& beam, const glm::vec3& along);

/// The share of a lamp's light that comes to where the distance squared is `distance_2`. By the inverse
/// square it reaches zero at the range; a range of 0 is none.
[[nodiscard]] float weakened(LightFalloff falloff, float range_m, float distance_2);

} // namespace estampe
