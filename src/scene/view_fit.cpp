// SPDX-License-Identifier: MIT
#include "scene/view_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/drawn_size.hpp"
#include "scene/extent.hpp"
#include "scene/view_analysis/strays.hpp"
#include "scene/view_analysis/subject.hpp"

namespace estampe {

std::optional<SceneSurvey> survey(const Scene& scene, const ScenePose& pose)
{
    check_drawn_size(scene);
    const Bounds whole = scene_bounds(scene, pose);
    if (whole.empty())
        return std::nullopt;
    check_extent(whole, scene.name);
    SceneSurvey result{
        .whole = whole, .cloud = surface_cloud(scene, pose_scene(scene, 0.0, no_index)), .analysis = {}};
    result.analysis = analyze_view(result.cloud);
    if (result.analysis.standpoint == Standpoint::outside)
        result.analysis.subject = subject_by_vertices(scene, pose, result.cloud, result.analysis.subject);
    return result;
}

double framed_half_height(double aspect)
{
    return std::min(std::tan(0.25), 0.8 / aspect);
}

/// Each side of the window is a plane whose place follows from the outermost point along its normal, so one
/// pass over the points is exact.
glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window)
{
    constexpr double lowest = -std::numeric_limits<double>::infinity();
    double left = lowest, right = lowest, top = lowest, bottom = lowest;
    for (const glm::dvec3& p : points) {
        right = std::max(right, p.x - window.side * p.z);
        left = std::max(left, -p.x - window.side * p.z);
        top = std::max(top, p.y - window.top * p.z);
        bottom = std::max(bottom, -p.y - window.bottom * p.z);
    }
    const double z_wide = -(left + right) / (2.0 * window.side);
    const double z_tall = -(top + bottom) / (window.top + window.bottom);
    const double z = std::min(z_wide, z_tall);
    const double lowest_y = top + window.top * z;
    const double highest_y = -bottom - window.bottom * z;
    return {0.5 * (right - left), 0.5 * (lowest_y + highest_y), z};
}

glm::dvec3 centre_eye(const std::vector<glm::dvec3>& points, const Window& window, glm::dvec3 eye)
{
    const double middle = 0.5 * (window.top - window.bottom);
    for (int round = 0; round < 4; ++round) {
        glm::dvec2 low{std::numeric_limits<double>::infinity()};
        glm::dvec2 high = -low;
        glm::dvec2 low_depth{0.0}, high_depth{0.0};
        for (const glm::dvec3& p : points) {
            const double depth = p.z - eye.z;
            for (int axis = 0; axis < 2; ++axis) {
                const double tangent = (p[axis] - eye[axis]) / depth;
                if (tangent < low[axis]) {
                    low[axis] = tangent;
                    low_depth[axis] = depth;
                }
                if (tangent > high[axis]) {
                    high[axis] = tangent;
                    high_depth[axis] = depth;
                }
            }
        }
        const glm::dvec2 wanted{0.0, middle};
        for (int axis = 0; axis < 2; ++axis)
            eye[axis] += (low[axis] + high[axis] - 2.0 * wanted[axis]) /
                         (1.0 / low_depth[axis] + 1.0 / high_depth[axis]);
    }
    return eye;
}

Subject::Subject(const Scene& scene, const ScenePose& pose, const ViewAnalysis& analysis, const Bounds& whole)
    : bounds_(bounds_without_strays(scene, pose, whole)), standing_(analysis.subject)
{
    has_floor_ = standing_.max.x - standing_.min.x < 0.99 * (bounds_.max.x - bounds_.min.x);
    slack_m_ = 0.02 * (standing_.max.y - standing_.min.y);
}

bool Subject::holds_vertex(const glm::dvec3& position) const
{
    if (!holds(bounds_, position))
        return false;
    return !has_floor_ || position.y > standing_.min.y + slack_m_ ||
           (position.x >= standing_.min.x && position.x <= standing_.max.x && position.z >= standing_.min.z &&
            position.z <= standing_.max.z);
}

bool Subject::has_floor_at(const glm::dvec3& position) const
{
    return has_floor_ && position.x >= bounds_.min.x && position.x <= bounds_.max.x &&
           position.z >= bounds_.min.z && position.z <= bounds_.max.z;
}

} // namespace estampe
