// SPDX-License-Identifier: MIT
// Cameras of a scene file, cameras given as text, such as "eye=1,2,3 fov=35 ortho", and views from a side
// (estampe/views.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>
#include <estampe/views.hpp>

#include "core/text.hpp"
#include "scene/framing.hpp"
#include "scene/pose.hpp"
#include "scene/scene_limits.hpp"
#include "scene/view_analysis/surface_points.hpp"

namespace estampe {
namespace {

/// Splits a text into words of the form "key=value" or "key". A number is parsed when its key is queried.
/// Every invalid word throws an Error that shows the correct form.
class CameraWords {
public:
    /// `form` describes the syntax with an example, for error messages; it must outlive this object. `lone`
    /// lists the keys that may have no value.
    CameraWords(const std::string& text, const char* form, std::initializer_list<std::string_view> keys,
                std::initializer_list<std::string_view> lone);

    /// Returns whether the key is present, with or without a value.
    [[nodiscard]] bool has(std::string_view key) const;
    /// Returns the number after a key; nothing if the key is missing or has no value.
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    /// Returns the three numbers after a key; nothing if the key is missing.
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view key) const;
    /// Returns the lens shift, after a range check; zero if the key is missing.
    [[nodiscard]] glm::dvec2 shift() const;
    /// Returns the vertical angle of view in degrees, after a range check; nothing if the key is missing.
    [[nodiscard]] std::optional<double> fov_deg() const;
    /// Returns half the height of a parallel projection in metres, after a range check; nothing if the key is
    /// missing.
    [[nodiscard]] std::optional<double> half_height_m() const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    [[nodiscard]] std::optional<std::string_view> value(std::string_view key) const;
    [[nodiscard]] double parse(std::string_view key, std::string_view digits) const;
    /// Returns the numbers after a key, separated by commas; nothing if the key is missing. `needs` describes
    /// them, for the error message.
    template <typename Vector>
    [[nodiscard]] std::optional<Vector> numbers(std::string_view key, const char* needs) const;

    std::string text_;
    const char* form_;
    std::map<std::string, std::optional<std::string>, std::less<>> words_;
};

CameraWords::CameraWords(const std::string& text, const char* form,
                         std::initializer_list<std::string_view> keys,
                         std::initializer_list<std::string_view> lone)
    : text_(text), form_(form)
{
    const auto is_among = [](std::string_view word, std::initializer_list<std::string_view> list) {
        return std::find(list.begin(), list.end(), word) != list.end();
    };
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        const std::string key = word.substr(0, equals);
        if (equals == std::string::npos && !is_among(key, lone))
            refuse(fmt::format("\"{}\" is not of the form key=value", word));
        if (!is_among(key, keys))
            refuse(fmt::format("unknown key \"{}\"", key));
        const auto value =
            equals == std::string::npos ? std::nullopt : std::optional(word.substr(equals + 1));
        if (!words_.emplace(key, value).second)
            refuse(fmt::format("\"{}\" is given twice", key));
    }
}

void CameraWords::refuse(const std::string& what) const
{
    throw Error(what, fmt::format("camera \"{}\"", text_), form_);
}

bool CameraWords::has(std::string_view key) const
{
    return words_.contains(key);
}

std::optional<std::string_view> CameraWords::value(std::string_view key) const
{
    const auto found = words_.find(key);
    return found != words_.end() && found->second ? std::optional<std::string_view>(*found->second)
                                                  : std::nullopt;
}

double CameraWords::parse(std::string_view key, std::string_view digits) const
{
    if (digits.starts_with('+'))
        digits.remove_prefix(1);
    const std::optional<double> number = number_from<double>(digits);
    if (!number || !(std::abs(*number) <= 1e12))
        refuse(fmt::format("{}: \"{}\" is not a number up to 1e12", key, digits));
    return *number;
}

std::optional<double> CameraWords::number(std::string_view key) const
{
    const std::optional<std::string_view> digits = value(key);
    return digits ? std::optional(parse(key, *digits)) : std::nullopt;
}

template <typename Vector>
std::optional<Vector> CameraWords::numbers(std::string_view key, const char* needs) const
{
    std::optional<std::string_view> list = value(key);
    if (!list)
        return std::nullopt;
    Vector vector{0.0};
    constexpr int last = Vector::length() - 1;
    for (int axis = 0; axis <= last; ++axis) {
        const size_t comma = list->find(',');
        if ((comma == std::string_view::npos) != (axis == last))
            refuse(fmt::format("{} needs {}", key, needs));
        vector[axis] = parse(key, list->substr(0, comma));
        list->remove_prefix(axis == last ? list->size() : comma + 1);
    }
    return vector;
}

std::optional<glm::dvec3> CameraWords::vector(std::string_view key) const
{
    return numbers<glm::dvec3>(key, "three numbers, x,y,z");
}

glm::dvec2 CameraWords::shift() const
{
    const glm::dvec2 shift = numbers<glm::dvec2>("shift", "two numbers, right,up").value_or(glm::dvec2(0.0));
    if (std::abs(shift.x) > farthest_shift || std::abs(shift.y) > farthest_shift)
        refuse(fmt::format("shift must be from -{0:g} to {0:g}", farthest_shift));
    return shift;
}

std::optional<double> CameraWords::fov_deg() const
{
    const std::optional<double> degrees = number("fov");
    if (degrees && (*degrees < 1.0 || *degrees > 170.0))
        refuse("fov must be from 1 to 170 degrees");
    return degrees;
}

std::optional<double> CameraWords::half_height_m() const
{
    const std::optional<double> half_m = number("ortho");
    if (half_m && *half_m <= 0.0)
        refuse("ortho must be greater than zero");
    return half_m;
}

constexpr const char* camera_form =
    "write \"eye=x,y,z target=x,y,z fov=degrees\", such as \"eye=2,1,3 target=0,0.5,0 fov=35\", and if need "
    "be up=x,y,z, ortho or ortho=half_height, shift=right,up";

bool are_parallel(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

std::string list_cameras(const Scene& scene)
{
    constexpr const char* other_forms =
        "write auto, \"eye=2,1,3 target=0,0.5,0 fov=35\" or \"azimuth=30 elevation=20\"; --view takes sides";
    if (scene.cameras.empty())
        return fmt::format("the scene has no cameras: leave --camera out, or {}", other_forms);
    std::string list;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        list += fmt::format("{}{} \"{}\"", list.empty() ? "" : ", ", i, scene.cameras[i].name);
    return fmt::format("cameras of the scene: {}; or {}", list, other_forms);
}

/// Finds the node of the camera called `name`, which is the name of the camera or of its node. If no camera
/// has the name, `name` is read as the index of a camera.
Index find_camera_node(const Scene& scene, const std::string& name)
{
    const Index number = number_from<Index>(name).value_or(no_index);
    Index numbered = no_index;
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (node.camera >= scene.cameras.size())
            continue;
        if (!name.empty() && (scene.cameras[node.camera].name == name || node.name == name))
            return index;
        if (node.camera == number && numbered == no_index)
            numbered = index;
    }
    return numbered;
}

} // namespace

Camera parse_camera(const std::string& text)
{
    const CameraWords words(text, camera_form, {"eye", "target", "fov", "up", "ortho", "shift"}, {"ortho"});
    Camera camera;
    for (const char* key : {"eye", "target"})
        if (!words.has(key))
            words.refuse(fmt::format("\"{}\" is missing", key));
    camera.eye = *words.vector("eye");
    camera.target = *words.vector("target");
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(view) <= 1e-9 * (1.0 + glm::length(camera.eye)))
        words.refuse("eye and target are the same point");
    if (const auto up = words.vector("up")) {
        if (glm::length(*up) == 0.0 || are_parallel(*up, view))
            words.refuse("up must not be zero, nor along the line from eye to target");
        camera.up = glm::normalize(*up);
    } else if (are_parallel(camera.up, view)) {
        camera.up = {0.0, 0.0, -1.0};
    }
    if (const auto degrees = words.fov_deg())
        camera.vertical_fov_rad = glm::radians(*degrees);
    if (words.has("ortho"))
        camera.orthographic_half_height_m =
            words.half_height_m().value_or(glm::length(view) * std::tan(0.5 * camera.vertical_fov_rad));
    camera.near_m = std::max(1e-6, 1e-3 * glm::length(view));
    camera.shift = words.shift();
    return camera;
}

Camera scene_camera(const Scene& scene, const ScenePose& pose, const std::string& name)
{
    const Index index = find_camera_node(scene, name);
    if (index == no_index)
        throw Error(fmt::format("no camera \"{}\"", name), scene.name, list_cameras(scene));
    const SceneCamera& lens = scene.cameras[scene.nodes[index].camera];
    const glm::dmat4& world_from_camera = pose.world_from_node[index];
    const glm::dvec3 back{world_from_camera[2]};
    const glm::dvec3 up{world_from_camera[1]};
    Camera camera;
    camera.eye = glm::dvec3(world_from_camera[3]);
    if (glm::length(back) == 0.0 || glm::length(up) == 0.0 || are_parallel(back, up))
        throw Error(fmt::format("the node of camera \"{}\" is scaled to nothing", name), scene.name,
                    "use --camera auto");
    camera.target = camera.eye - glm::normalize(back);
    camera.up = glm::normalize(up);
    camera.vertical_fov_rad = lens.vertical_fov_rad;
    if (lens.orthographic)
        camera.orthographic_half_height_m = lens.half_height_m;
    camera.near_m = lens.near_m;
    return camera;
}

namespace {

constexpr std::array<const char*, 8> names{"front", "back",   "left",      "right",
                                           "top",   "bottom", "isometric", "three-quarter"};

constexpr const char* direction_form =
    "write \"azimuth=degrees elevation=degrees\", such as \"azimuth=30 elevation=20\": azimuth 0 looks from "
    "+z and sees the front, 90 looks from +x; and if need be distance=metres, target=x,y,z, fov=degrees, "
    "ortho or ortho=half_height";

/// Returns the axes of a view in a given direction. The direction may be straight down or straight up.
ViewAxes axes_of(const ViewDirection& from)
{
    const double azimuth_rad = glm::radians(from.azimuth_deg);
    const glm::dvec3 forward = -bearing(azimuth_rad, glm::radians(from.elevation_deg));
    const glm::dvec3 right(std::cos(azimuth_rad), 0.0, -std::sin(azimuth_rad));
    return {right, glm::cross(right, forward), forward};
}

/// Returns half the height in metres of a parallel projection in which `seen` fits on the page with a margin.
double fitting_half_height(const Bounds& seen, double aspect)
{
    const glm::dvec3 half = 0.5 * (seen.max - seen.min);
    // Width of the margin on both sides together, as a share of half the picture's height.
    const double rim = 2.0 * framed_margin * std::min(1.0, aspect);
    return std::max(half.y / (1.0 - rim), half.x / (aspect - rim));
}

/// Returns the points of the subject in camera space, relative to the centre of the subject.
std::vector<glm::dvec3> subject_points(const Scene& scene, const ScenePose& pose, const Subject& subject,
                                       const ViewAxes& axes)
{
    const glm::dvec3 origin = subject.bounds().center();
    std::vector<glm::dvec3> points;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            if (subject.holds_vertex(position))
                points.push_back(axes.of(position - origin));
        }
    });
    return stand_in_points(points, subject, axes).value_or(std::move(points));
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
        analysis.subject = whole; // The whole scene is the subject, so that even a room is shown from outside
    // A view from a requested side also shows the floor, unless the floor extends far beyond the objects on
    // it.
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
    // `points` are relative to the centre of the subject, so the eye is computed relative to it.
    glm::dvec3 eye = seen.center();
    double distance_m = 0.0; // distance from the eye to the centre of the visible subject
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
