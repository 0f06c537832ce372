// SPDX-License-Identifier: MIT
#include "scene/view_analysis/subject.hpp"

#include <algorithm>
#include <array>

#include "scene/pose.hpp"
#include "scene/view_analysis/strays.hpp"

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

/// Whether what lies at the floor's level is ground to stand on: a thin sheet that fills its rectangle. The
/// brim of a hat, a saucer, arms along the ground or a plinth are parts of the thing itself.
bool is_sheet(const SurfaceCloud& cloud, double level)
{
    constexpr int grid = 16;
    constexpr double most_thickness = 0.02; // of its width
    constexpr double most_of_it = 0.9;      // a disc fills 0.79
    Bounds floor;
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y <= level)
            floor.extend(position);
    }
    const glm::dvec3 size = floor.max - floor.min;
    if (floor.empty() || size.y > most_thickness * std::max(size.x, size.z))
        return false;
    std::array<bool, grid * grid> is_filled{};
    for (const SurfacePoint& point : cloud.points) {
        const glm::dvec3 position = glm::dvec3(point.position) + cloud.origin;
        if (position.y > level)
            continue;
        const glm::dvec3 part = (position - floor.min) / glm::max(size, glm::dvec3(1e-300));
        const auto cell = [](double share) {
            return std::clamp(static_cast<int>(share * grid), 0, grid - 1);
        };
        is_filled[static_cast<size_t>(cell(part.x) * grid + cell(part.z))] = true;
    }
    return static_cast<double>(std::ranges::count(is_filled, true)) >= most_of_it * grid * grid;
}

/// What stands on the floor at `level`, if the floor is the lowest thing and much wider; else all.
Bounds without_floor(const SurfaceCloud& cloud, Bounds standing, double level)
{
    const Bounds& all = cloud.bounds;
    const glm::dvec3 whole = all.max - all.min;
    const glm::dvec3 part = standing.max - standing.min;
    const bool floor_is_lowest = level - all.min.y < 0.25 * whole.y;
    // Each way: two and a half times the ground that is stood on; a thousand times where it is no plain
    // sheet.
    const double much_wider = is_sheet(cloud, level) ? 1.6 : 30.0;
    if (!floor_is_lowest || whole.x < much_wider * part.x || whole.z < much_wider * part.z)
        return all;
    standing.min.y = std::min(standing.min.y, level);
    return standing;
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
    return without_floor(cloud, standing, level);
}

Bounds subject_by_vertices(const Scene& scene, const ScenePose& pose, const SurfaceCloud& cloud,
                           const Bounds& found)
{
    const bool is_whole = found.min == cloud.bounds.min && found.max == cloud.bounds.max;
    if (!is_whole || cloud.points.empty())
        return found;
    const double level = floor_level(cloud);
    const auto is_above = [&](const SurfacePoint& point) {
        return static_cast<double>(point.position.y) + cloud.origin.y > level;
    };
    const auto above = std::ranges::count_if(cloud.points, is_above);
    if (static_cast<size_t>(above) > cloud.points.size() / 16)
        return found; // what stands there is in the cloud
    Bounds standing;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            if (position.y > level && holds(cloud.bounds, position))
                standing.extend(position);
        }
    });
    return standing.radius() > 0.0 ? without_floor(cloud, standing, level) : found;
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
