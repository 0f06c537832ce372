// SPDX-License-Identifier: MIT
#include "scene/outlook/subject.hpp"

#include <algorithm>
#include <array>

namespace estampe {
namespace {

constexpr int level_count = 64;

/// The level that most of what faces upwards lies on.
double floor_level(const SurfaceCloud& cloud)
{
    std::array<int, level_count> upward{};
    const double low = cloud.bounds.min.y;
    const double step = std::max((cloud.bounds.max.y - low) / level_count, 1e-12);
    for (const SurfacePoint& point : cloud.points) {
        const float up = point.two_sided ? std::abs(point.normal.y) : point.normal.y;
        const double height = static_cast<double>(point.position.y) + cloud.origin.y - low;
        if (up > 0.98F)
            ++upward[static_cast<size_t>(std::clamp(height / step, 0.0, level_count - 1.0))];
    }
    const auto most = std::max_element(upward.begin(), upward.end());
    return low + step * (static_cast<double>(most - upward.begin()) + 1.0);
}

} // namespace

Bounds subject_bounds(const SurfaceCloud& cloud)
{
    const double level = floor_level(cloud);
    Bounds standing;
    size_t below = 0;
    size_t above = 0;
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y > level) {
            standing.extend(position);
            ++above;
        } else {
            ++below;
        }
    }
    if (above < 32 || below < cloud.points.size() / 16)
        return cloud.bounds;
    const glm::dvec3 whole = cloud.bounds.max - cloud.bounds.min;
    const glm::dvec3 part = standing.max - standing.min;
    const bool floor_is_lowest = level - cloud.bounds.min.y < 0.25 * whole.y;
    constexpr double much_wider = 1.6; // each way, so two and a half times the ground that is stood on
    if (!floor_is_lowest || whole.x < much_wider * part.x || whole.z < much_wider * part.z)
        return cloud.bounds;
    standing.min.y = std::min(standing.min.y, level);
    return standing;
}

SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject)
{
    SurfaceCloud inside{.origin = cloud.origin, .bounds = subject};
    const double slack = 1e-6 * subject.radius();
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 p = glm::dvec3(point.position) + cloud.origin;
        if (glm::all(glm::greaterThanEqual(p, subject.min - slack)) &&
            glm::all(glm::lessThanEqual(p, subject.max + slack)))
            inside.points.push_back(point);
    }
    return inside;
}

} // namespace estampe
