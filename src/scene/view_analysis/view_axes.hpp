// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace estampe {

/// The directions of a view. A point as the camera sees it from the origin: to the right, upwards, away.
struct ViewAxes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;

    [[nodiscard]] glm::dvec3 of(const glm::dvec3& point) const
    {
        return {glm::dot(right, point), glm::dot(up, point), glm::dot(forward, point)};
    }

    [[nodiscard]] glm::dvec3 world(const glm::dvec3& v) const
    {
        return right * v.x + up * v.y + forward * v.z;
    }
};

/// Where a bearing and a height above the horizon lie: 0 is +z, a quarter turn +x.
inline glm::dvec3 bearing(double azimuth_rad, double elevation_rad)
{
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
            std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

/// The view of an eye that stands at a bearing and looks at the origin; not straight from above or below.
inline ViewAxes look_from(double azimuth_rad, double elevation_rad)
{
    const glm::dvec3 forward = -bearing(azimuth_rad, elevation_rad);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    return {right, glm::cross(right, forward), forward};
}

} // namespace estampe
