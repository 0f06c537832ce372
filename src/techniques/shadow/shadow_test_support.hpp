// SPDX-License-Identifier: MIT
#pragma once

// Shared by the tests of shadows.

#include "support/drawing.hpp"
#include "techniques/light/light.glsl.h"

namespace estampe::shadow {

/// A white sun.
[[nodiscard]] inline shared::LightRecord sun_record(const glm::dvec3& towards_sun)
{
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = glm::vec3(towards_sun);
    sun.color = glm::vec3(1.0F);
    return sun;
}

/// A clipmap around the eye of a drawing, with levels of `size` texels per side.
[[nodiscard]] inline Clipmap clipmap_of(const test::Drawing& drawing, const glm::dvec3& towards_sun,
                                        uint32_t size)
{
    return fit_clipmap(drawing.sun(towards_sun, size), size, 0.01, drawing.pose.casters.radius());
}

} // namespace estampe::shadow
