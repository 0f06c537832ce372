// SPDX-License-Identifier: MIT
// The viewer's handling of keys, the pointer and the gamepad.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace estampe::viewer {

void Viewer::go_back()
{
    if (has_pointer_) {
        take_pointer(false);
    } else if (studio_.shows_keys) {
        studio_.shows_keys = false;
    } else if (loader_->is_loading()) {
        loader_->cancel();
        studio_.work.reset();
        studio_.say(Message::Kind::note, "scene", "Reading was cancelled.");
        report("cancelled");
    } else if (studio_.work) {
        pictures_->cancel_job();
    } else if (!studio_.messages.empty() && studio_.messages.back().kind == Message::Kind::problem) {
        studio_.messages.pop_back();
    } else if (studio_.comparison.other) {
        studio_.comparison.other.reset();
    } else if (studio_.rig.mode() != CameraMode::orbit) {
        studio_.rig.set_mode(CameraMode::orbit);
    } else if (studio_.shows_panel) {
        studio_.shows_panel = false;
    } else {
        window_.close();
    }
}

bool Viewer::act_on_view(Action action)
{
    constexpr double roll_rad = 0.0873;
    CameraRig& rig = studio_.rig;
    switch (action) {
    case Action::orbit:
        rig.set_mode(CameraMode::orbit);
        return true;
    case Action::fly:
        rig.set_mode(CameraMode::fly);
        return true;
    case Action::walk:
        rig.set_mode(CameraMode::walk);
        return true;
    case Action::home:
        rig.set_mode(CameraMode::orbit);
        rig.go_home();
        return true;
    case Action::front:
        rig.look_from(ViewSide::front);
        return true;
    case Action::back_side:
        rig.look_from(ViewSide::back);
        return true;
    case Action::right:
        rig.look_from(ViewSide::right);
        return true;
    case Action::left:
        rig.look_from(ViewSide::left);
        return true;
    case Action::bottom:
        rig.look_from(ViewSide::bottom);
        return true;
    case Action::top:
        rig.look_from(ViewSide::top);
        return true;
    case Action::isometric:
        rig.look_from(ViewSide::isometric);
        return true;
    case Action::projection:
        rig.toggle_projection();
        return true;
    case Action::roll_left:
        rig.roll(-roll_rad);
        return true;
    case Action::roll_right:
        rig.roll(roll_rad);
        return true;
    case Action::add_bookmark:
        studio_.add_bookmark();
        return true;
    case Action::bookmark_back:
        studio_.step_bookmark(-1);
        return true;
    case Action::bookmark_on:
        studio_.step_bookmark(1);
        return true;
    default:
        return false;
    }
}

bool Viewer::act_on_style(Action action)
{
    const auto open_tab = [this](PanelTab tab) {
        studio_.shows_bars = true;
        studio_.shows_panel = true;
        studio_.tab = tab;
        studio_.wants_tab = true;
    };
    switch (action) {
    case Action::undo:
        studio_.is_at_terrain() ? studio_.terrain->undo() : studio_.edited.undo();
        return true;
    case Action::redo:
        studio_.is_at_terrain() ? studio_.terrain->redo() : studio_.edited.redo();
        return true;
    case Action::style_back:
        studio_.step_preset(-1);
        return true;
    case Action::style_on:
        studio_.step_preset(1);
        return true;
    case Action::compare:
        studio_.toggle_comparison();
        return true;
    case Action::search:
        open_tab(PanelTab::style);
        studio_.wants_search = true;
        return true;
    case Action::save_style:
        if (studio_.is_at_terrain()) {
            studio_.save_terrain(studio_.terrain->name());
            return true;
        }
        open_tab(PanelTab::style);
        studio_.wants_save = true;
        return true;
    case Action::timings:
        open_tab(PanelTab::timings);
        return true;
    default:
        return false;
    }
}

void Viewer::act(Action action)
{
    constexpr double frame_s = 1.0 / 24.0;
    const bool steers = studio_.rig.mode() != CameraMode::orbit;
    if (action == Action::next_animation && steers) {
        return; // In fly and walk mode the key W moves ahead, and does not choose an animation
    }
    const bool is_of_feet = action == Action::frame_back || action == Action::frame_on ||
                            action == Action::reload || action == Action::play;
    if (is_of_feet && is_on_foot()) {
        // In walk mode the arrow keys move the walker and Space jumps. The commands that arrow keys and Space
        // run in other modes are not run.
        return;
    }
    if (act_on_view(action) || act_on_style(action)) {
        return;
    }
    Timeline& time = studio_.time;
    switch (action) {
    case Action::show_keys:
        studio_.shows_keys = !studio_.shows_keys;
        break;
    case Action::toggle_panel:
        studio_.shows_panel = !studio_.shows_panel || !studio_.shows_bars;
        studio_.shows_bars = true;
        break;
    case Action::toggle_bars:
        studio_.shows_bars = !studio_.shows_bars;
        break;
    case Action::toggle_full_screen:
        window_.toggle_full_screen();
        break;
    case Action::back:
        go_back();
        break;
    case Action::quit:
        window_.close();
        break;
    case Action::play:
        time.toggle_playing();
        break;
    case Action::next_animation:
        if (studio_.file && studio_.file->scene.animations.size() > 1) {
            const auto& animations = studio_.file->scene.animations;
            time.animation = static_cast<Index>((time.animation + 1) % animations.size());
            time.length_s = animations[time.animation].duration_s;
            time.time_s = 0.0;
        }
        break;
    case Action::frame_back:
        time.is_playing = false;
        time.seek(time.time_s - frame_s);
        break;
    case Action::frame_on:
        time.is_playing = false;
        time.seek(time.time_s + frame_s);
        break;
    case Action::screenshot:
        take_screenshot();
        break;
    case Action::record:
        toggle_recording();
        break;
    case Action::reload:
        read_scene_again();
        break;
    case Action::up_axis:
        studio_.step_up_axis();
        read_scene_again();
        break;
    default:
        break;
    }
}

void Viewer::move_by_keys(double seconds)
{
    studio_.time.advance(seconds);
    // Longest time in seconds by which one frame moves the camera, so that the camera does not leap after a
    // slow frame.
    constexpr double longest_s = 0.2;
    if (is_on_foot()) {
        go_on_foot(std::min(seconds, longest_s));
        return;
    }
    take_pointer(false);
    if (studio_.rig.mode() == CameraMode::orbit) {
        return;
    }
    const auto axis = [this](int less, int more) {
        return (window_.is_down(more) ? 1.0 : 0.0) - (window_.is_down(less) ? 1.0 : 0.0);
    };
    const glm::dvec3 way(axis(GLFW_KEY_A, GLFW_KEY_D), axis(GLFW_KEY_C, GLFW_KEY_E),
                         axis(GLFW_KEY_S, GLFW_KEY_W));
    if (way != glm::dvec3(0.0)) {
        studio_.rig.go(way, std::min(seconds, longest_s),
                       window_.is_down(GLFW_KEY_LEFT_SHIFT) || window_.is_down(GLFW_KEY_RIGHT_SHIFT));
    }
}

void Viewer::drag(const glm::dvec2& way, const PointerEvent& event, const Area& area)
{
    if (is_on_foot() && (drag_ == Drag::pan || drag_ == Drag::zoom)) {
        return; // In walk mode a drag does not move the camera, only walking does
    }
    switch (drag_) {
    case Drag::turn:
        studio_.rig.turn(way);
        break;
    case Drag::pan:
        studio_.rig.pan(way);
        break;
    case Drag::zoom:
        studio_.rig.zoom(-20.0 * way.y);
        break;
    case Drag::sun:
        studio_.turn_sun(way);
        break;
    case Drag::split:
        studio_.comparison.split =
            std::clamp((static_cast<float>(event.place.x) - area.x) / area.width, 0.02F, 0.98F);
        break;
    case Drag::none:
        break;
    }
}

void Viewer::press(const PointerEvent& event, const Area& area)
{
    const double split_x = area.x + area.width * studio_.comparison.split;
    const bool is_on_split = studio_.comparison.other && std::abs(event.place.x - split_x) < 8.0 * ui_scale_;
    switch (event.button) {
    case GLFW_MOUSE_BUTTON_LEFT:
        drag_ = is_on_split                               ? Drag::split
                : window_.is_down(GLFW_KEY_L)             ? Drag::sun
                : (event.modifiers & GLFW_MOD_SHIFT) != 0 ? Drag::pan
                                                          : Drag::turn;
        break;
    case GLFW_MOUSE_BUTTON_RIGHT:
        drag_ = Drag::zoom;
        break;
    case GLFW_MOUSE_BUTTON_MIDDLE:
        drag_ = Drag::pan;
        break;
    default:
        break;
    }
}

void Viewer::follow_pointer(const std::vector<PointerEvent>& events)
{
    const Area area = picture_area(studio_, ui_scale_);
    for (const PointerEvent& event : events) {
        const glm::dvec2 way = (event.place - pointer_) / static_cast<double>(area.height);
        pointer_ = event.place;
        const bool is_in_picture = event.place.x >= area.x && event.place.x < area.x + area.width &&
                                   event.place.y >= area.y && event.place.y < area.y + area.height;
        const bool is_free = is_in_picture && !ImGui::GetIO().WantCaptureMouse && studio_.file;
        switch (event.kind) {
        case PointerEvent::Kind::press:
            if (has_pointer_) {
                take_pointer(false);
            } else if (is_free && is_on_foot() && event.button == GLFW_MOUSE_BUTTON_LEFT &&
                       event.modifiers == 0 && !studio_.comparison.other && !window_.is_down(GLFW_KEY_L)) {
                take_pointer(true);
            } else if (drag_ == Drag::none && is_free) {
                press(event, area);
            }
            break;
        case PointerEvent::Kind::release:
            if (drag_ == Drag::sun) {
                studio_.edited.finish_change();
            }
            drag_ = Drag::none;
            break;
        case PointerEvent::Kind::move:
            if (has_pointer_) {
                studio_.rig.turn(-way); // While the pointer is hidden, its movement turns the view
            } else {
                drag(way, event, area);
            }
            break;
        case PointerEvent::Kind::wheel:
            if (is_free && !is_on_foot()) {
                studio_.rig.zoom(event.wheel);
            }
            break;
        }
    }
}

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
    if (camera.eye != walked_to_) { // The camera was moved by another command, not by walking
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
