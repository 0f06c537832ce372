// SPDX-License-Identifier: MIT
#pragma once

// What the maps of a local light look at: a spot's one map along its beam, an omni's six along the axes.

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/shadow/local/local.glsl.h"

namespace estampe::shadow {

/// All of a local light that its maps depend on, in anchor space.
struct LocalLight {
    glm::vec3 position{0.0F};
    float range_m = 1.0F;           ///< what is farther away is neither lit nor drawn
    glm::vec3 beam{0.0F, 0.0F, -1}; ///< unit; of spots
    glm::vec3 side{1.0F, 0.0F, 0};  ///< unit, square to the beam; a pyramid's sides are along it and across
    float half_angle_rad = 0.0F;    ///< of a spot's cone or pyramid; 0: shines to all sides
    uint32_t casters = ~0U;         ///< groups of objects that throw shadows in its light

    /// Six maps: a light to all sides, or a spot too wide for one.
    [[nodiscard]] bool is_cube() const;

    [[nodiscard]] uint32_t map_count() const { return is_cube() ? 6 : 1; }

    bool operator==(const LocalLight&) const = default;
};

/// Texels about each map beyond what it has to show, so that lookups near its border find neighbours there.
inline constexpr uint32_t rim_texels = 2;

/// The record that lookups read, of maps of `size` texels a side that begin at `first_texel`. `radius_m` is
/// that of the ball that glows.
[[nodiscard]] shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel,
                                               float radius_m = 0.0F);

/// One map to draw. In clip space y points down, z is reversed: near_m at the near plane, 0 at infinity.
struct LocalView {
    glm::mat4 clip_from_anchor{1.0F};
    uint32_t first_texel = 0;
};

/// The maps of `light` that `shadow` tells of, in their order.
[[nodiscard]] std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow);

} // namespace estampe::shadow
