// SPDX-License-Identifier: MIT
#include <estampe/views.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "scene/camera_words.hpp"
#include "scene/pose.hpp"
#include "scene/view_analysis/view_axes.hpp"
#include "scene/view_fit.hpp"

namespace estampe {
namespace {

constexpr std::array<const char*, 8> names{"front", "back",   "left",      "right",
                                           "top",   "bottom", "isometric", "three-quarter"};

constexpr const char* direction_form =
    "write \"azimuth=degrees elevation=degrees\", such as \"azimuth=30 elevation=20\": azimuth 0 looks from "
    "+z and sees the front, 90 looks from +x; and if need be distance=metres, target=x,y,z, fov=degrees, "
    "ortho or ortho=half_height";

/// The directions of a view, also of one straight down or up.
ViewAxes axes_of(const ViewDirection& from)
{
    const double azimuth_rad = glm::radians(from.azimuth_deg);
    const glm::dvec3 forward = -bearing(azimuth_rad, glm::radians(from.elevation_deg));
    const glm::dvec3 right(std::cos(azimuth_rad), 0.0, -std::sin(azimuth_rad));
    return {right, glm::cross(right, forward), forward};
}

/// Half the height of the page in metres that holds `seen` with the margin, in parallel projection.
double fitting_half_height(const Bounds& seen, double aspect)
{
    const glm::dvec3 half = 0.5 * (seen.max - seen.min);
    const double rim = 2.0 * framed_margin * std::min(1.0, aspect); // of half the height
    return std::max(half.y / (1.0 - rim), half.x / (aspect - rim));
}

/// Points as the camera sees them from the middle of the scene; two where the scene has no extent.
std::vector<glm::dvec3> subject_points(const Scene& scene, const ScenePose& pose, const Subject& subject,
                                       const ViewAxes& axes)
{
    const glm::dvec3 origin = subject.bounds().center();
    std::vector<glm::dvec3> points;
    Bounds extent;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            if (subject.holds_vertex(position)) {
                points.push_back(axes.of(position - origin));
                extent.extend(points.back());
            }
        }
    });
    const double least = std::max({1e-12 * glm::length(origin), 1e-6 * subject.bounds().radius(), 1e-9});
    if (extent.radius() < least)
        return {extent.center() - least, extent.center() + least};
    return points;
}

Bounds bounds_of(const std::vector<glm::dvec3>& points)
{
    Bounds bounds;
    for (const glm::dvec3& point : points)
        bounds.extend(point);
    return bounds;
}

} // namespace

std::span<const char* const> view_names()
{
    return names;
}

std::optional<NamedView> named_view(std::string_view name)
{
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<NamedView>(found - names.begin()));
}

ViewDirection direction_of(NamedView view)
{
    switch (view) {
    case NamedView::front:
        break;
    case NamedView::back:
        return {.azimuth_deg = 180.0};
    case NamedView::left:
        return {.azimuth_deg = -90.0};
    case NamedView::right:
        return {.azimuth_deg = 90.0};
    case NamedView::top:
        return {.elevation_deg = 90.0};
    case NamedView::bottom:
        return {.elevation_deg = -90.0};
    case NamedView::isometric:
        return {.azimuth_deg = 45.0,
                .elevation_deg = glm::degrees(std::asin(1.0 / std::sqrt(3.0))),
                .parallel = true};
    case NamedView::three_quarter:
        return {.azimuth_deg = 35.0, .elevation_deg = 18.0};
    }
    return {};
}

ViewDirection parse_view_direction(const std::string& text)
{
    const CameraWords words(text, direction_form,
                            {"azimuth", "elevation", "distance", "target", "fov", "ortho"}, {"ortho"});
    if (!words.has("azimuth") && !words.has("elevation"))
        words.refuse("\"azimuth\" is missing");
    ViewDirection from{.azimuth_deg = words.number("azimuth").value_or(0.0),
                       .elevation_deg = words.number("elevation").value_or(0.0),
                       .distance_m = words.number("distance"),
                       .target = words.vector("target"),
                       .fov_deg = words.fov_deg(),
                       .half_height_m = words.half_height_m(),
                       .parallel = words.has("ortho")};
    if (std::abs(from.azimuth_deg) > 360.0)
        words.refuse("azimuth must be from -360 to 360 degrees");
    if (std::abs(from.elevation_deg) > 90.0)
        words.refuse("elevation must be from -90 to 90 degrees");
    if (from.distance_m && !(*from.distance_m >= 1e-6))
        words.refuse("distance must be greater than zero");
    if (from.target && !from.distance_m && !from.half_height_m)
        words.refuse("target needs distance or ortho=half_height, which say how much is seen about it");
    return from;
}

Camera view_camera(const Scene& scene, const ScenePose& pose, double aspect, const ViewDirection& from)
{
    std::optional<SceneSurvey> surveyed = survey(scene, pose);
    if (!surveyed)
        return {};
    if (!(aspect > 0.0))
        aspect = 1.0;
    const Bounds& whole = surveyed->whole;
    const SurfaceCloud& cloud = surveyed->cloud;
    ViewAnalysis& analysis = surveyed->analysis;
    if (analysis.standpoint == Standpoint::inside)
        analysis.subject = whole; // seen from outside after all
    // A view that was asked for shows the floor too, unless that is ground far beyond what stands on it.
    constexpr double far_wider = 4.0;
    const glm::dvec3 all_m = cloud.bounds.max - cloud.bounds.min;
    const glm::dvec3 subject_m = analysis.subject.max - analysis.subject.min;
    if (!cloud.points.empty() && (all_m.x < far_wider * subject_m.x || all_m.z < far_wider * subject_m.z))
        analysis.subject = cloud.bounds;
    const Subject subject(scene, pose, analysis, whole);
    const ViewAxes axes = axes_of(from);
    const std::vector<glm::dvec3> points = subject_points(scene, pose, subject, axes);
    const Bounds seen = bounds_of(points);
    const double half_height =
        from.fov_deg ? std::tan(0.5 * glm::radians(*from.fov_deg)) : framed_half_height(aspect);

    Camera camera;
    camera.up = std::abs(from.elevation_deg) > 89.9 ? axes.up : glm::dvec3(0.0, 1.0, 0.0);
    camera.vertical_fov_rad = 2.0 * std::atan(half_height);
    glm::dvec3 eye = seen.center(); // as the points are
    double distance_m = 0.0;        // from the eye to the middle of what is seen
    if (from.parallel || from.distance_m) {
        const double fitting_m = fitting_half_height(seen, aspect);
        const double half_m = from.half_height_m ? *from.half_height_m
                              : from.distance_m  ? *from.distance_m * half_height
                                                 : fitting_m;
        if (from.parallel)
            camera.orthographic_half_height_m = half_m;
        distance_m =
            from.distance_m ? *from.distance_m : std::max(half_m / half_height, seen.max.z - seen.min.z);
        eye.z -= distance_m;
    } else {
        const double rim = 2.0 * framed_margin * half_height * std::min(1.0, aspect);
        const Window window{
            .side = half_height * aspect - rim, .top = half_height - rim, .bottom = half_height - rim};
        eye = centre_eye(points, window, fit_eye(points, window));
        distance_m = seen.center().z - eye.z;
    }
    const glm::dvec3 middle = subject.bounds().center();
    camera.eye = from.target ? *from.target - axes.forward * distance_m : middle + axes.world(eye);
    camera.target = camera.eye + axes.forward * distance_m;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& point : points)
        nearest = std::min(nearest, axes.of(middle - camera.eye).z + point.z);
    camera.near_m = std::max(0.1 * nearest, 1e-4 * 2.0 * seen.radius());
    return camera;
}

Camera with_parallel_projection(const Camera& camera, const glm::dvec3& focus)
{
    const glm::dvec3 way = camera.target - camera.eye;
    const double depth_m = glm::dot(focus - camera.eye, glm::normalize(way));
    Camera parallel = camera;
    if (!camera.orthographic_half_height_m)
        parallel.orthographic_half_height_m =
            (depth_m > 0.0 ? depth_m : glm::length(way)) * std::tan(0.5 * camera.vertical_fov_rad);
    return parallel;
}

} // namespace estampe
