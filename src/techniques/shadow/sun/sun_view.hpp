// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "techniques/shadow/shadow_style.hpp"
#include "techniques/shadow/sun/sun.glsl.h"

namespace estampe::shadow {

/// The sun's parallel view of everything that throws a shadow.
struct SunView {
    glm::mat4 clip_from_anchor{1.0F}; ///< reversed z: 1 nearest to the sun, 0 farthest
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 down{0.0F, 0.0F, 1.0F};
    glm::vec2 extent_m{1.0F}; ///< what the map covers along both
    float texel_m = 0.0F;     ///< the longer side of a texel
    glm::vec2 warp{0.0F};     ///< of a map in perspective: rows are at y = warp.x - warp.y / w; extent_m and
                              ///< texel_m are those where w is 1
    float depth_m = 1.0F;     ///< what clip z of 0 to 1 spans
};

/// Fits the view to `casters` (world space), whatever receives: outside of it nothing can be in shadow.
/// `towards_sun` is a unit vector, `size` the map's side in texels. Empty casters give a view of one metre.
[[nodiscard]] SunView sun_view(const Bounds& casters, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                               uint32_t size);

/// What the light pass needs to look up a map of that view, `size` texels a side; 0 for no shadow.
[[nodiscard]] shared::SunShadow sun_shadow(const SunView& view, uint32_t size, const ShadowStyle& style = {});

} // namespace estampe::shadow
