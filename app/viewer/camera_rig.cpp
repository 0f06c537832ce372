// SPDX-License-Identifier: MIT
#include "viewer/camera_rig.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "scene/static_triangles.hpp"

namespace estampe::viewer {
namespace {

/// Returns twice the signed area of a triangle seen from above.
float area_above(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

} // namespace

Ground::Ground(const Scene& scene)
{
    const StaticTriangles all = static_triangles(scene);
    anchor_ = all.anchor;
    for (size_t i = 0; i + 2 < all.positions.size(); i += 3) {
        const std::array corners{all.positions[i], all.positions[i + 1], all.positions[i + 2]};
        if (area_above(corners[0], corners[1], corners[2]) != 0.0F) {
            triangles_.push_back(corners);
        }
    }
}

std::optional<double> Ground::height_under(const glm::dvec3& place) const
{
    const glm::vec3 from(place - anchor_);
    std::optional<float> highest;
    for (const auto& [a, b, c] : triangles_) {
        if (from.x < std::min({a.x, b.x, c.x}) || from.x > std::max({a.x, b.x, c.x}) ||
            from.z < std::min({a.z, b.z, c.z}) || from.z > std::max({a.z, b.z, c.z})) {
            continue;
        }
        const float whole = area_above(a, b, c);
        const float by_a = area_above(from, b, c) / whole;
        const float by_b = area_above(a, from, c) / whole;
        const float by_c = 1.0F - by_a - by_b;
        const float y = by_a * a.y + by_b * b.y + by_c * c.y;
        if (by_a >= 0.0F && by_b >= 0.0F && by_c >= 0.0F && y <= from.y && (!highest || y > *highest)) {
            highest = y;
        }
    }
    return highest ? std::optional(anchor_.y + static_cast<double>(*highest)) : std::nullopt;
}

namespace {

/// Steepest angle at which the camera can look up or down.
constexpr double steepest_rad = 0.497 * std::numbers::pi;

glm::dvec3 rotated(const glm::dvec3& direction, double angle_rad, const glm::dvec3& axis)
{
    return glm::angleAxis(angle_rad, axis) * direction;
}

} // namespace

void CameraRig::set_scene(const Camera& home, const Bounds& bounds, Ground ground)
{
    home_ = home;
    bounds_ = bounds;
    ground_ = std::move(ground);
    mode_ = CameraMode::orbit;
    place(home);
}

void CameraRig::place(const Camera& camera)
{
    camera_ = camera;
    camera_.up = glm::normalize(camera_.up);
}

void CameraRig::set_mode(CameraMode mode)
{
    mode_ = mode;
    if (mode == CameraMode::walk) {
        // The height of the walker's eye is that of a person. If the scene is apparently not in metres, the
        // height is a share of the scene's height.
        const double height_m = bounds_.empty() ? 3.0 : bounds_.max.y - bounds_.min.y;
        constexpr double person_m = 1.7;
        eye_height_m_ = height_m > person_m && height_m < 1000.0 * person_m ? person_m : 0.3 * height_m;
        camera_.orthographic_half_height_m.reset();
        stand();
    }
}

glm::dvec3 CameraRig::ahead() const
{
    const glm::dvec3 way = camera_.target - camera_.eye;
    const double length = glm::length(way);
    return length > 0.0 ? way / length : glm::dvec3(0.0, 0.0, -1.0);
}

glm::dvec3 CameraRig::world_up() const
{
    return mode_ == CameraMode::orbit ? camera_.up : glm::dvec3(0.0, 1.0, 0.0);
}

double CameraRig::step_m() const
{
    const double radius_m = bounds_.radius();
    return radius_m > 0.0 ? radius_m : 1.0;
}

/// Returns a direction rotated by a drag of the pointer, but not beyond the zenith and the nadir of `up`.
static glm::dvec3 turned(const glm::dvec3& direction, const glm::dvec3& up, double yaw_rad, double pitch_rad)
{
    const double height_rad = std::asin(std::clamp(glm::dot(direction, up), -1.0, 1.0));
    const double next_rad = std::clamp(height_rad + pitch_rad, -steepest_rad, steepest_rad);
    glm::dvec3 right = glm::cross(direction, up);
    const double length = glm::length(right);
    if (length < 1e-9) {
        right = std::abs(up.x) < 0.9 ? glm::cross(glm::dvec3(1.0, 0.0, 0.0), up)
                                     : glm::cross(glm::dvec3(0.0, 0.0, 1.0), up);
    }
    right = glm::normalize(right);
    return rotated(rotated(direction, next_rad - height_rad, right), yaw_rad, up);
}

void CameraRig::turn(const glm::dvec2& drag)
{
    if (mode_ == CameraMode::orbit) {
        // A drag over the view's whole height turns the view by half a turn, so that the model follows the
        // pointer.
        const double distance_m = glm::length(camera_.target - camera_.eye);
        const glm::dvec3 direction =
            turned(ahead(), world_up(), -drag.x * std::numbers::pi, -drag.y * std::numbers::pi);
        camera_.eye = camera_.target - direction * distance_m;
    } else {
        // The factor is chosen so that the point of the scene under the pointer moves with the pointer.
        const double angle_rad = camera_.vertical_fov_rad;
        look_along(turned(ahead(), world_up(), drag.x * angle_rad, drag.y * angle_rad));
    }
}

void CameraRig::look_along(const glm::dvec3& direction)
{
    camera_.target = camera_.eye + direction * std::max(glm::length(camera_.target - camera_.eye), 1e-6);
    camera_.up = world_up();
}

void CameraRig::pan(const glm::dvec2& drag)
{
    const double distance_m = glm::length(camera_.target - camera_.eye);
    const double height_m = camera_.orthographic_half_height_m
                                ? 2.0 * *camera_.orthographic_half_height_m
                                : 2.0 * distance_m * std::tan(0.5 * camera_.vertical_fov_rad);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead(), camera_.up));
    const glm::dvec3 up = glm::cross(right, ahead());
    const glm::dvec3 way = height_m * (up * drag.y - right * drag.x);
    camera_.eye += way;
    camera_.target += way;
}

void CameraRig::zoom(double steps)
{
    constexpr double nearer_a_step = 0.9;
    const double factor = std::pow(nearer_a_step, steps);
    if (mode_ != CameraMode::orbit) {
        go({0.0, 0.0, steps}, 0.15, false);
        return;
    }
    const double least_m = 1e-5 * step_m();
    const double most_m = 1e4 * step_m();
    if (camera_.orthographic_half_height_m) {
        camera_.orthographic_half_height_m =
            std::clamp(*camera_.orthographic_half_height_m * factor, least_m, most_m);
    } else {
        const double distance_m = glm::length(camera_.target - camera_.eye);
        camera_.eye = camera_.target - ahead() * std::clamp(distance_m * factor, least_m, most_m);
    }
}

void CameraRig::roll(double angle_rad)
{
    if (mode_ == CameraMode::orbit) {
        camera_.up = rotated(camera_.up, angle_rad, ahead());
    }
}

void CameraRig::go(const glm::dvec3& direction, double seconds, bool is_fast)
{
    constexpr double share_of_scene_a_s = 0.4;
    constexpr double walk_m_a_s = 1.4;
    const double speed_m =
        (mode_ == CameraMode::walk ? walk_m_a_s * eye_height_m_ / 1.7 : share_of_scene_a_s * step_m()) *
        (is_fast ? 4.0 : 1.0) * seconds;
    glm::dvec3 forward = ahead();
    const glm::dvec3 up = world_up();
    if (mode_ == CameraMode::walk) {
        forward -= up * glm::dot(forward, up);
        forward = glm::length(forward) > 1e-9 ? glm::normalize(forward) : glm::dvec3(0.0);
    }
    const glm::dvec3 right = glm::cross(ahead(), up);
    const glm::dvec3 level = glm::length(right) > 1e-9 ? glm::normalize(right) : glm::dvec3(0.0);
    glm::dvec3 way = forward * direction.z + level * direction.x;
    if (mode_ != CameraMode::walk) {
        way += up * direction.y;
    }
    camera_.eye += way * speed_m;
    camera_.target += way * speed_m;
    if (mode_ == CameraMode::walk) {
        stand();
    }
}

void CameraRig::stand()
{
    const double floor_m = bounds_.empty() ? 0.0 : bounds_.min.y;
    const std::optional<double> under_m = ground_ ? ground_(camera_.eye) : std::nullopt;
    const double rise_m = under_m.value_or(floor_m) + eye_height_m_ - camera_.eye.y;
    camera_.eye.y += rise_m;
    camera_.target.y += rise_m;
    look_along(ahead());
}

void CameraRig::look_from(ViewSide side)
{
    mode_ = CameraMode::orbit;
    const glm::dvec3 center = bounds_.empty() ? camera_.target : bounds_.center();
    const double distance_m = std::max(glm::length(home_.eye - home_.target),
                                       1.05 * step_m() / std::sin(0.5 * home_.vertical_fov_rad));
    glm::dvec3 from(0.0, 0.0, 1.0);
    glm::dvec3 up(0.0, 1.0, 0.0);
    switch (side) {
    case ViewSide::front:
        break;
    case ViewSide::back:
        from = {0.0, 0.0, -1.0};
        break;
    case ViewSide::left:
        from = {-1.0, 0.0, 0.0};
        break;
    case ViewSide::right:
        from = {1.0, 0.0, 0.0};
        break;
    case ViewSide::bottom:
        from = {0.0, -1.0, 0.0};
        up = {0.0, 0.0, 1.0};
        break;
    case ViewSide::top:
        from = {0.0, 1.0, 0.0};
        up = {0.0, 0.0, -1.0};
        break;
    case ViewSide::isometric:
        from = glm::normalize(glm::dvec3(1.0, 1.0, 1.0));
        break;
    }
    camera_.target = center;
    camera_.eye = center + from * distance_m;
    camera_.up = up;
}

void CameraRig::toggle_projection()
{
    if (camera_.orthographic_half_height_m) {
        camera_.orthographic_half_height_m.reset();
    } else {
        camera_.orthographic_half_height_m =
            glm::length(camera_.target - camera_.eye) * std::tan(0.5 * camera_.vertical_fov_rad);
    }
}

} // namespace estampe::viewer
