// SPDX-License-Identifier: MIT
// What keys and buttons do.
#include "viewer/viewer.hpp"

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

bool Viewer::act_on_look(Action action)
{
    const auto open_tab = [this](PanelTab tab) {
        studio_.shows_bars = true;
        studio_.shows_panel = true;
        studio_.tab = tab;
        studio_.wants_tab = true;
    };
    switch (action) {
    case Action::undo:
        studio_.is_at_terrain() ? studio_.terrain->undo() : studio_.look.undo();
        return true;
    case Action::redo:
        studio_.is_at_terrain() ? studio_.terrain->redo() : studio_.look.redo();
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
        return; // W goes ahead
    }
    const bool is_of_feet = action == Action::frame_back || action == Action::frame_on ||
                            action == Action::reload || action == Action::play;
    if (is_of_feet && is_on_foot()) {
        return; // arrows walk, and Space jumps
    }
    if (act_on_view(action) || act_on_look(action)) {
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

} // namespace estampe::viewer
