// SPDX-License-Identifier: MIT
// What the pointer does in the picture, and the keys that are held.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace estampe::viewer {

void Viewer::move_by_keys(double seconds)
{
    studio_.time.advance(seconds);
    constexpr double longest_s = 0.2; // a stall is no leap
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
        return; // feet alone take a walker elsewhere
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
                studio_.look.finish_change();
            }
            drag_ = Drag::none;
            break;
        case PointerEvent::Kind::move:
            if (has_pointer_) {
                studio_.rig.turn(-way); // the head goes with the hand
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

} // namespace estampe::viewer
