// SPDX-License-Identifier: MIT
// Somebody on foot in a world that has walls, by keys, pointer or gamepad.
#include "viewer/viewer.hpp"

#include <algorithm>

namespace estampe::viewer {

bool Viewer::is_on_foot() const
{
    return studio_.file && studio_.file->visit && studio_.rig.mode() == CameraMode::walk;
}

void Viewer::set_out()
{
    const walk::Walker& walker = studio_.file->visit->walker();
    constexpr double wide_rad = 0.92;
    const glm::dvec3 eye_m = walker.eye_m();
    studio_.rig.set_mode(CameraMode::walk);
    studio_.rig.place({.eye = eye_m,
                       .target = eye_m + glm::dvec3(0.03, 0.02, -1.0),
                       .vertical_fov_rad = wide_rad,
                       .near_m = 0.1});
    walked_to_ = eye_m;
    studio_.time.is_playing = true;
}

void Viewer::take_pointer(bool is_taken)
{
    if (is_taken != has_pointer_) {
        has_pointer_ = is_taken;
        window_.take_pointer(is_taken);
    }
}

void Viewer::go_on_foot(double seconds)
{
    worlds::Visit& visit = *studio_.file->visit;
    walk::Walker& walker = visit.walker();
    Camera camera = studio_.rig.camera();
    if (camera.eye != walked_to_) { // somebody was put elsewhere
        walker.put(camera.eye - glm::dvec3(0.0, static_cast<double>(walker.body().eye_m), 0.0));
    }
    const Gamepad pad = window_.gamepad();
    const auto axis = [this](std::initializer_list<int> less, std::initializer_list<int> more) {
        const auto is_any_down = [this](int key) { return window_.is_down(key); };
        return (std::ranges::any_of(more, is_any_down) ? 1.0 : 0.0) -
               (std::ranges::any_of(less, is_any_down) ? 1.0 : 0.0);
    };
    const double aside = axis({GLFW_KEY_A, GLFW_KEY_LEFT}, {GLFW_KEY_D, GLFW_KEY_RIGHT}) + pad.walk.x;
    const double ahead = axis({GLFW_KEY_S, GLFW_KEY_DOWN}, {GLFW_KEY_W, GLFW_KEY_UP}) - pad.walk.y;
    constexpr double turns_rad_s = 2.2;
    if (pad.look != glm::dvec2(0.0)) {
        studio_.rig.turn(-turns_rad_s * seconds / camera.vertical_fov_rad * pad.look);
        camera = studio_.rig.camera();
    }
    const glm::dvec3 look = camera.target - camera.eye;
    const double level = std::max(glm::length(glm::dvec2(look.x, look.z)), 1e-9);
    const glm::dvec2 forward = glm::dvec2(look.x, look.z) / level;
    const bool runs =
        pad.runs || window_.is_down(GLFW_KEY_LEFT_SHIFT) || window_.is_down(GLFW_KEY_RIGHT_SHIFT);
    visit.go({.way = ahead * forward + aside * glm::dvec2(-forward.y, forward.x),
              .runs = runs,
              .jumps = pad.jumps || window_.is_down(GLFW_KEY_SPACE)},
             seconds, studio_.time.time_s);
    camera.eye = walker.eye_m();
    camera.target = camera.eye + look;
    studio_.rig.place(camera);
    walked_to_ = camera.eye;
    SceneChange change{.prints = walker.take_prints()};
    if (visit.has_arrived() && !end_s_) {
        end_s_ = studio_.time.time_s;
        change.end_s = end_s_;
    }
    pictures_->change(std::move(change));
}

} // namespace estampe::viewer
