// SPDX-License-Identifier: MIT
#include "film_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "drawing.hpp"

namespace estampe::app {
namespace {

constexpr int moment_count = 13; // Number of times at which moving parts are sampled
constexpr int side_count = 12;   // Number of directions from which the view of a turntable is checked

Camera turned(const Camera& camera, double turn)
{
    const glm::dmat4 rotation =
        glm::rotate(glm::dmat4(1.0), 2.0 * std::numbers::pi * turn, glm::dvec3(0.0, 1.0, 0.0));
    Camera other = camera;
    other.eye = camera.target + glm::dvec3(rotation * glm::dvec4(camera.eye - camera.target, 0.0));
    other.up = glm::dvec3(rotation * glm::dvec4(camera.up, 0.0));
    return other;
}

/// Returns how far the box reaches from the middle of the page: 1 is the edge of the page.
double reach(const Camera& camera, const Bounds& box, double aspect)
{
    const std::optional<double>& half_height_m = camera.orthographic_half_height_m;
    const glm::dmat4 view = glm::lookAt(camera.eye, camera.target, camera.up);
    const double tangent = std::tan(0.5 * camera.vertical_fov_rad);
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place((corner & 1) != 0 ? box.max.x : box.min.x,
                               (corner & 2) != 0 ? box.max.y : box.min.y,
                               (corner & 4) != 0 ? box.max.z : box.min.z);
        const glm::dvec3 seen(view * glm::dvec4(place, 1.0));
        const double half_m = half_height_m.value_or(std::max(-seen.z, camera.near_m) * tangent);
        const glm::dvec2 on_page =
            glm::dvec2(seen) / glm::dvec2(half_m * aspect, half_m) - 2.0 * camera.shift;
        most = std::max({most, std::abs(on_page.x), std::abs(on_page.y)});
    }
    return most;
}

/// Moves the eye away from the target until all of `boxes` fit on the page from all of `sides`, with the same
/// margin as the first box has from the first side.
Camera far_enough(const Camera& camera, const std::vector<Bounds>& boxes, int sides, double aspect)
{
    const auto farthest = [&](const Camera& from) {
        double most = 0.0;
        for (int side = 0; side < sides; ++side) {
            const Camera seen = turned(from, static_cast<double>(side) / sides);
            for (const Bounds& box : boxes) {
                most = std::max(most, reach(seen, box, aspect));
            }
        }
        return most;
    };
    const double allowed = reach(camera, boxes.front(), aspect);
    Camera away = camera;
    constexpr int rounds = 24;
    for (int round = 0; round < rounds && farthest(away) > 1.001 * allowed; ++round) {
        const double farther = std::min(farthest(away) / allowed, 1.3);
        away.eye = away.target + (away.eye - away.target) * farther;
        if (away.orthographic_half_height_m) {
            *away.orthographic_half_height_m *= farther;
        }
    }
    return away;
}

} // namespace

FilmCamera::FilmCamera(const DrawOptions& draw, const Scene& scene, Index animation, double begin_s,
                       double end_s, bool turntable, std::shared_ptr<const worlds::CameraPath> path)
    : draw_(draw), scene_(scene), animation_(animation), path_(std::move(path))
{
    if (path_ || has_camera_of_file(draw, scene)) {
        return;
    }
    DrawOptions first = draw;
    first.time_s = begin_s;
    still_ = choose_camera(first, scene, animation);
    const ViewDirection& from = draw.camera.direction;
    const bool is_framed =
        draw.camera.kind != CameraChoice::Kind::placed && !from.distance_m && !from.half_height_m;
    const int sides = turntable ? side_count : 1;
    const int moments = scene.animations.empty() ? 1 : moment_count;
    if (!is_framed || sides * moments == 1) {
        return;
    }
    std::vector<Bounds> boxes;
    for (int i = 0; i < moments; ++i) {
        const double time_s = begin_s + (end_s - begin_s) * i / std::max(moments - 1, 1);
        boxes.push_back(scene_bounds(scene, pose_scene(scene, time_s, animation)));
    }
    if (!boxes.front().empty()) {
        still_ =
            far_enough(*still_, boxes, sides, draw.style.window_aspect(draw.page.width, draw.page.height));
    }
}

Camera FilmCamera::at(double time_s, double turn) const
{
    if (path_) {
        return path_->camera(time_s - draw_.time_s);
    }
    if (still_) {
        return turned(*still_, turn);
    }
    DrawOptions now = draw_;
    now.time_s = time_s;
    return turned(choose_camera(now, scene_, animation_), turn);
}

} // namespace estampe::app
