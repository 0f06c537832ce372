// SPDX-License-Identifier: MIT
#include "techniques/shadow/sun/sun_view.hpp"

#include <algorithm>
#include <cmath>

namespace estampe::shadow {

SunView sun_view(const Bounds& casters, const glm::dvec3& anchor, const glm::dvec3& towards_sun,
                 uint32_t size)
{
    const glm::dvec3 helper = std::abs(towards_sun.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, towards_sun));
    const glm::dvec3 up = glm::cross(towards_sun, right);
    Bounds seen;
    for (int i = 0; i < 8 && !casters.empty(); ++i) {
        const glm::dvec3 corner = glm::dvec3((i & 1) != 0 ? casters.max.x : casters.min.x,
                                             (i & 2) != 0 ? casters.max.y : casters.min.y,
                                             (i & 4) != 0 ? casters.max.z : casters.min.z) -
                                  anchor;
        seen.extend({glm::dot(corner, right), glm::dot(corner, up), glm::dot(corner, towards_sun)});
    }
    if (seen.empty()) {
        seen.extend(glm::dvec3(-0.5));
        seen.extend(glm::dvec3(0.5));
    }
    // A rim of two texels keeps the casters' own outline inside, and no side may be empty.
    const glm::dvec3 extent = glm::max(seen.max - seen.min, glm::dvec3(1e-3 * std::max(seen.radius(), 1e-6)));
    const double rim = 1.0 + 4.0 / static_cast<double>(size);
    const glm::dvec3 half = 0.5 * rim * extent;
    const glm::dvec3 center = seen.center();

    const auto row = [](const glm::dvec3& axis, double scale, double offset) {
        return glm::dvec4(axis * scale, offset * scale);
    };
    const glm::dvec4 x = row(right, 1.0 / half.x, -center.x);
    const glm::dvec4 y = row(up, -1.0 / half.y, -center.y);
    glm::dvec4 z = row(towards_sun, 0.5 / half.z, -center.z);
    z.w += 0.5;
    SunView view;
    view.clip_from_anchor = glm::mat4(glm::transpose(glm::dmat4(x, y, z, glm::dvec4(0, 0, 0, 1))));
    view.right = glm::vec3(right);
    view.down = glm::vec3(-up);
    view.extent_m = glm::vec2(2.0 * half);
    view.texel_m = static_cast<float>(2.0 * std::max(half.x, half.y) / static_cast<double>(size));
    view.depth_m = static_cast<float>(2.0 * half.z);
    return view;
}

shared::SunShadow sun_shadow(const SunView& view, uint32_t size, const ShadowStyle& style)
{
    return {.clip_from_anchor = view.clip_from_anchor,
            .right = view.right,
            .texel_m = view.texel_m,
            .down = view.down,
            .depth_m = view.depth_m,
            .texels_per_m = static_cast<float>(size) / view.extent_m,
            .size = size,
            .sun_slope = std::tan(glm::radians(style.sun_radius_deg)),
            .warp = view.warp};
}

} // namespace estampe::shadow
