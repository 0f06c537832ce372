// SPDX-License-Identifier: MIT
#include "scene/framing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "scene/pose.hpp"
#include "scene/scene_limits.hpp"
#include "scene/view_analysis/subject.hpp"
#include "scene/view_analysis/surface_points.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "scene/visibility.hpp"

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

/// On each side of the window, the outermost point along the normal of the bounding plane limits the eye.
/// Therefore a single pass over the points gives the exact result.
glm::dvec3 fit_eye(const std::vector<glm::dvec3>& points, const Window& window)
{
    // Without a least distance, points that lie one behind the other would draw the eye into the first of
    // them.
    constexpr double least_distance = 0.05; // as a share of the depth of all points
    constexpr double lowest = -std::numeric_limits<double>::infinity();
    double left = lowest, right = lowest, top = lowest, bottom = lowest;
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = lowest;
    for (const glm::dvec3& p : points) {
        nearest = std::min(nearest, p.z);
        farthest = std::max(farthest, p.z);
        right = std::max(right, p.x - window.side * p.z);
        left = std::max(left, -p.x - window.side * p.z);
        top = std::max(top, p.y - window.top * p.z);
        bottom = std::max(bottom, -p.y - window.bottom * p.z);
    }
    const double z_wide = -(left + right) / (2.0 * window.side);
    const double z_tall = -(top + bottom) / (window.top + window.bottom);
    const double z = std::min({z_wide, z_tall, nearest - least_distance * (farthest - nearest)});
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

namespace {

/// Smallest extent in metres of a subject that can be framed: any smaller is lost in the rounding of its
/// place.
double least_extent(const Bounds& bounds)
{
    return std::max({1e-12 * glm::length(bounds.center()), 1e-6 * bounds.radius(), 1e-9});
}

} // namespace

std::optional<std::vector<glm::dvec3>> stand_in_points(const std::vector<glm::dvec3>& points,
                                                       const Subject& subject, const ViewAxes& axes)
{
    const Bounds& bounds = subject.bounds();
    std::vector<glm::dvec3> corners;
    for (int corner = 0; points.empty() && corner < 8; ++corner) {
        const glm::dvec3 side{(corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2 & 1) - 0.5};
        corners.push_back(axes.of(side * (bounds.max - bounds.min)));
    }
    Bounds extent;
    for (const glm::dvec3& point : points.empty() ? corners : points)
        extent.extend(point);
    const double least = least_extent(bounds);
    if (extent.radius() < least)
        return std::vector{extent.center() - least, extent.center() + least};
    return points.empty() ? std::optional(std::move(corners)) : std::nullopt;
}

namespace {

// Extra margin below the subject for its shadow, as a share of the picture's shorter side.
constexpr double shadow_room = 0.03;

/// Horizontal extent of points in the picture, as tangents. `depth` is the depth of the leftmost or the
/// rightmost point, whichever is nearer.
struct Across {
    double left = std::numeric_limits<double>::infinity();
    double right = -std::numeric_limits<double>::infinity();
    double depth = std::numeric_limits<double>::infinity();

    Across(const std::vector<glm::dvec3>& points, const glm::dvec3& eye)
    {
        double left_depth = 1.0;
        double right_depth = 1.0;
        for (const glm::dvec3& p : points) {
            const double tangent = (p.x - eye.x) / (p.z - eye.z);
            if (tangent < left) {
                left = tangent;
                left_depth = p.z - eye.z;
            }
            if (tangent > right) {
                right = tangent;
                right_depth = p.z - eye.z;
            }
        }
        depth = std::min(left_depth, right_depth);
    }
};

/// Moves the eye sideways to bring the subject nearer to the middle of the picture, as far as all points stay
/// inside the picture.
glm::dvec3 lean_to_subject(const std::vector<glm::dvec3>& all, const std::vector<glm::dvec3>& subject,
                           const Window& window, glm::dvec3 eye)
{
    constexpr double part = 0.6;
    const Across whole(all, eye);
    const Across within(subject, eye);
    const double wanted = part * 0.5 * (within.left + within.right);
    const double most = std::max(0.0, window.side - std::max(whole.right, -whole.left));
    eye.x += std::clamp(wanted, -most, most) * whole.depth;
    return eye;
}

/// The points that the picture must contain, in camera space relative to the middle of the subject.
struct ViewPoints {
    std::vector<glm::dvec3> subject;
    std::vector<glm::dvec3> shadow; ///< shadow on the ground of each point of the subject
};

glm::dvec3 towards(const SunBearing& sun, const ViewAnalysis& analysis)
{
    return sun.turns ? analysis.towards_sun(sun.azimuth_deg, sun.elevation_deg)
                     : bearing(glm::radians(sun.azimuth_deg), glm::radians(sun.elevation_deg));
}

/// Direction towards the light that casts the framed shadow. The light is the strongest directional light of
/// the scene. If the scene has no light, or if the sun replaces the scene's lights, it is the default sun.
std::optional<glm::dvec3> shadow_light(const Scene& scene, const ScenePose& pose,
                                       const ViewAnalysis& analysis, const SunBearing& sun)
{
    if (sun.rules) {
        return towards(sun, analysis);
    }
    std::optional<glm::dvec3> found;
    float strongest = 0.0F;
    bool has_light = false;
    const std::vector<bool> visible = visible_nodes(scene);
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        if (!visible[index] || scene.nodes[index].light >= scene.lights.size())
            continue;
        has_light = true;
        const Light& light = scene.lights[scene.nodes[index].light];
        const float brightness = light.intensity * (light.color.x + light.color.y + light.color.z);
        const glm::dvec3 back(pose.world_from_node[index][2]);
        if (light.type != LightType::directional || brightness <= strongest || glm::length(back) == 0.0)
            continue;
        strongest = brightness;
        found = glm::normalize(back);
    }
    return !has_light && !analysis.shelter ? towards(sun, analysis) : found;
}

ViewPoints view_points(const Scene& scene, const ScenePose& pose, const ViewAxes& axes,
                       const ViewAnalysis& analysis, const SunBearing& sun, const Subject& subject)
{
    // Smallest sine of the sun's height (15 degrees); shadows of a lower sun are too long for the page.
    constexpr double lowest_sun = 0.26;
    ViewPoints points;
    const auto light = shadow_light(scene, pose, analysis, sun);
    const bool has_ground = sun.on_blank_ground.value_or(scene.cameras.empty());
    const bool has_shadow = sun.throws && light && light->y > lowest_sun;
    const glm::dvec3 origin = subject.bounds().center();
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            if (!subject.holds_vertex(position))
                continue;
            points.subject.push_back(axes.of(position - origin));
            if (!has_shadow)
                continue;
            const glm::dvec3 shadow = position - *light * ((position.y - analysis.subject.min.y) / light->y);
            const bool is_seen = has_ground || subject.has_floor_at(shadow);
            points.shadow.push_back(axes.of((is_seen ? shadow : position) - origin));
        }
    });
    return points;
}

/// Returns the subject's points. If there is a shadow, also returns points between each point and its shadow;
/// `part` is the share of the way.
std::vector<glm::dvec3> with_shadow(const ViewPoints& points, double part)
{
    std::vector<glm::dvec3> all = points.subject;
    for (size_t i = 0; i < points.shadow.size(); ++i)
        all.push_back(glm::mix(points.subject[i], points.shadow[i], part));
    return all;
}

/// An eye position, and the share of the way from the subject to the end of its shadow that fits into the
/// picture.
struct Fit {
    glm::dvec3 eye{0.0};
    double shadow_part = 0.0;
};

Fit fit_part(const ViewPoints& points, const Window& window, double part)
{
    const std::vector<glm::dvec3> all = with_shadow(points, part);
    const glm::dvec3 eye = centre_eye(all, window, fit_eye(all, window));
    return {lean_to_subject(all, points.subject, window, eye), part};
}

/// Finds the eye that shows as much of the shadow as possible: the whole shadow, or the largest part of the
/// shadow that leaves the subject large enough and near the middle of the picture.
Fit fit_with_shadow(const ViewPoints& points, const Window& window)
{
    constexpr double least_size = 0.74; // smallest size of the subject, as a share of its size without shadow
    constexpr double most_aside = 0.42; // largest offset from the page's middle, as a share of half its width
    const glm::dvec3 alone = fit_eye(points.subject, window);
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points.subject)
        nearest = std::min(nearest, point.z);
    const double farthest_eye = nearest - (nearest - alone.z) / least_size;
    for (double part = points.shadow.empty() ? 0.0 : 1.0; part > 0.0; part -= 0.125) {
        const Fit fit = fit_part(points, window, part);
        const Across subject(points.subject, fit.eye);
        if (fit.eye.z >= farthest_eye &&
            std::abs(subject.left + subject.right) <= 2.0 * most_aside * window.side)
            return fit;
    }
    return {centre_eye(points.subject, window, alone), 0.0};
}

/// Returns about 4096 of the points, at regular steps through the list.
ViewPoints thinned(const ViewPoints& points)
{
    ViewPoints few;
    const size_t step = 1 + points.subject.size() / 4096;
    for (size_t i = 0; i < points.subject.size(); i += step) {
        few.subject.push_back(points.subject[i]);
        if (!points.shadow.empty())
            few.shadow.push_back(points.shadow[i]);
    }
    return few;
}

/// The inner part of the picture, in which none of the outermost points can lie.
struct Core {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};

    Core(const std::vector<glm::dvec3>& points, const glm::dvec3& eye)
    {
        for (const glm::dvec3& point : points) {
            const glm::dvec2 at = glm::dvec2(point - eye) / (point.z - eye.z);
            min = glm::min(min, at);
            max = glm::max(max, at);
        }
        const glm::dvec2 rim = 0.15 * (max - min);
        min += rim;
        max -= rim;
    }

    [[nodiscard]] bool holds(const glm::dvec3& point, const glm::dvec3& eye) const
    {
        const glm::dvec2 at = glm::dvec2(point - eye) / (point.z - eye.z);
        return glm::all(glm::greaterThan(at, min)) && glm::all(glm::lessThan(at, max));
    }
};

/// Computes the eye for all points: first estimates it from a few points, then corrects it with the points
/// near the rim of the picture.
glm::dvec3 framed_eye(const ViewPoints& points, const Window& window)
{
    const ViewPoints few = thinned(points);
    const Fit rough = fit_with_shadow(few, window);
    const Core subject(few.subject, rough.eye);
    const Core all(with_shadow(few, rough.shadow_part), rough.eye);
    ViewPoints rim;
    for (size_t i = 0; i < points.subject.size(); ++i) {
        const glm::dvec3& shadow = points.shadow.empty() ? points.subject[i] : points.shadow[i];
        if (subject.holds(points.subject[i], rough.eye) &&
            all.holds(glm::mix(points.subject[i], shadow, rough.shadow_part), rough.eye))
            continue;
        rim.subject.push_back(points.subject[i]);
        if (rough.shadow_part > 0.0)
            rim.shadow.push_back(shadow);
    }
    return fit_part(rim, window, rough.shadow_part).eye;
}

/// Chooses the direction of view. Objects are shown in three-quarter view from slightly above. Characters are
/// shown from near their front, with the eye at the height of their eyes.
ViewAxes axes_for(const Scene& scene, const SurfaceCloud& cloud, const ViewAnalysis& analysis, double aspect)
{
    const std::optional<double> eyes_m = analysis.standpoint == Standpoint::outside
                                             ? eye_level(scene, within(cloud, analysis.subject))
                                             : std::nullopt;
    if (!eyes_m)
        return look_from(analysis.azimuth_rad, analysis.elevation_rad);
    const glm::dvec3 size = analysis.subject.max - analysis.subject.min;
    const double usable = 1.0 - 2.0 * framed_margin * std::min(1.0, aspect) - shadow_room;
    const double distance_m = 0.5 * std::max(size.y, size.x / aspect) / (usable * framed_half_height(aspect));
    const double rise_m = *eyes_m - analysis.subject.center().y;
    const double elevation_rad = std::asin(std::clamp(rise_m / distance_m, 0.0, 0.3));
    // The eye looks from near the front, or from near the back if the analysis has chosen a view from behind.
    const double middle_rad = std::cos(analysis.azimuth_rad) > 0.0 ? 0.0 : std::numbers::pi;
    constexpr double aside = 0.5; // direction of view between front view (0) and three-quarter view (1)
    return look_from(glm::mix(middle_rad, analysis.azimuth_rad, aside), elevation_rad);
}

/// Returns a camera with a wide lens in the corner of a closed room.
Camera camera_inside(const ViewAnalysis& analysis, double aspect)
{
    Camera camera;
    const ViewAxes axes = look_from(analysis.azimuth_rad, analysis.elevation_rad);
    camera.eye = analysis.corner;
    camera.target = analysis.corner + axes.forward * analysis.subject.radius();
    camera.vertical_fov_rad = 2.0 * std::atan(std::min(0.62, 1.0 / aspect));
    camera.near_m = 1e-3 * analysis.subject.radius();
    return camera;
}

} // namespace

Camera framing_camera(const Scene& scene, const ScenePose& pose, double aspect, const SunBearing& sun)
{
    const std::optional<SceneSurvey> surveyed = survey(scene, pose);
    if (!surveyed)
        return {};
    if (!(aspect > 0.0))
        aspect = 1.0;
    const ViewAnalysis& analysis = surveyed->analysis;
    if (analysis.standpoint == Standpoint::inside)
        return camera_inside(analysis, aspect);
    const Subject subject(scene, pose, analysis, surveyed->whole);
    const ViewAxes axes = axes_for(scene, surveyed->cloud, analysis, aspect);
    const Bounds& bounds = subject.bounds();

    const double half_height = framed_half_height(aspect);
    const double shorter = 2.0 * half_height * std::min(1.0, aspect);
    const Window window{.side = half_height * aspect - framed_margin * shorter,
                        .top = half_height - framed_margin * shorter,
                        .bottom = half_height - (framed_margin + shadow_room) * shorter};

    ViewPoints points = view_points(scene, pose, axes, analysis, sun, subject);
    if (auto standing_in = stand_in_points(points.subject, subject, axes))
        points = {.subject = std::move(*standing_in)};
    const glm::dvec3 eye = framed_eye(points, window);

    Camera camera;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points.subject)
        nearest = std::min(nearest, point.z - eye.z);
    const double span = 2.0 * std::max(bounds.radius(), least_extent(bounds));
    camera.eye = bounds.center() + axes.world(eye);
    camera.target = camera.eye - axes.forward * eye.z;
    camera.vertical_fov_rad = 2.0 * std::atan(half_height);
    camera.near_m = analysis.cut_wall ? nearest + 1e-3 * span : std::max(0.1 * nearest, 1e-4 * span);
    return camera;
}

} // namespace estampe
