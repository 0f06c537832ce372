// SPDX-License-Identifier: MIT
#include "viewer/window.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include <estampe/error.hpp>
#include <imgui.h>

#include <backends/imgui_impl_glfw.h>

namespace estampe::viewer {
namespace {

std::atomic<bool> is_open = false; ///< The window exists, so that other threads may call GLFW to wake it

constexpr int least_width_px = 320;
constexpr int least_height_px = 200;

/// Returns the number of the window's pixels that lie on a monitor.
int64_t shared_px(const glm::ivec4& window, GLFWmonitor* monitor)
{
    int x = 0;
    int y = 0;
    glfwGetMonitorPos(monitor, &x, &y);
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    const int width = std::min(window.x + window.z, x + mode->width) - std::max(window.x, x);
    const int height = std::min(window.y + window.w, y + mode->height) - std::max(window.y, y);
    return int64_t{std::max(width, 0)} * std::max(height, 0);
}

} // namespace

Window::Window(uint32_t width, uint32_t height)
{
    if (glfwInit() != GLFW_TRUE) {
        throw Error("there is no display to open a window on", "",
                    "set DISPLAY or WAYLAND_DISPLAY; estampe render needs none");
    }
    is_open = true;
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "estampe");
    handle_ =
        glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), "Estampe", nullptr, nullptr);
    if (handle_ == nullptr) {
        glfwTerminate();
        throw Error("the display opens no window", "", "estampe render needs none");
    }
    glfwSetWindowSizeLimits(handle_, least_width_px, least_height_px, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(handle_, this);
    float scale_y = 1.0F;
    glfwGetWindowContentScale(handle_, &content_scale_, &scale_y);
    watch_keys();
    watch_rest();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // ImGui stores no settings on disk
    // ImGui's event handlers also call the callbacks that were set before.
    ImGui_ImplGlfw_InitForOther(handle_, true);
}

Window::~Window()
{
    is_open = false;
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

Window& Window::of(GLFWwindow* handle)
{
    Window& window = *static_cast<Window*>(glfwGetWindowUserPointer(handle));
    window.events_.any = true;
    return window;
}

void Window::watch_keys()
{
    glfwSetKeyCallback(handle_, [](GLFWwindow* handle, int key, int /*code*/, int action, int modifiers) {
        Window& window = of(handle);
        const std::optional<Action> asked = action_of_key(key, modifiers);
        const bool is_typing = ImGui::GetIO().WantTextInput && asked != Action::save_style;
        if (action == GLFW_RELEASE || !asked || is_typing) {
            return;
        }
        const bool repeats = *asked == Action::frame_back || *asked == Action::frame_on ||
                             *asked == Action::undo || *asked == Action::redo;
        if (action == GLFW_PRESS || repeats) {
            window.events_.actions.push_back(*asked);
        }
    });
    glfwSetCharCallback(handle_, [](GLFWwindow* handle, unsigned int letter) {
        Window& window = of(handle);
        const std::optional<Action> asked = action_of_letter(letter);
        if (asked && !ImGui::GetIO().WantTextInput) {
            window.events_.actions.push_back(*asked);
        }
    });
}

void Window::watch_rest()
{
    glfwSetMouseButtonCallback(handle_, [](GLFWwindow* handle, int button, int action, int modifiers) {
        PointerEvent event{.kind =
                               action == GLFW_PRESS ? PointerEvent::Kind::press : PointerEvent::Kind::release,
                           .button = button,
                           .modifiers = modifiers};
        event.place = of(handle).pointer_;
        of(handle).events_.pointer.push_back(event);
    });
    glfwSetCursorPosCallback(handle_, [](GLFWwindow* handle, double x, double y) {
        of(handle).pointer_ = {x, y};
        of(handle).events_.pointer.push_back({.kind = PointerEvent::Kind::move, .place = {x, y}});
    });
    glfwSetScrollCallback(handle_, [](GLFWwindow* handle, double, double steps) {
        PointerEvent event{.kind = PointerEvent::Kind::wheel, .wheel = steps};
        event.place = of(handle).pointer_;
        of(handle).events_.pointer.push_back(event);
    });
    glfwSetCursorEnterCallback(handle_, [](GLFWwindow* handle, int) { of(handle); });
    glfwSetWindowFocusCallback(handle_, [](GLFWwindow* handle, int) { of(handle); });
    glfwSetFramebufferSizeCallback(handle_, [](GLFWwindow* handle, int, int) { of(handle); });
    glfwSetWindowRefreshCallback(handle_, [](GLFWwindow* handle) { of(handle); });
    glfwSetWindowIconifyCallback(handle_, [](GLFWwindow* handle, int) { of(handle); });
    glfwSetWindowContentScaleCallback(
        handle_, [](GLFWwindow* handle, float scale, float) { of(handle).content_scale_ = scale; });
    glfwSetDropCallback(handle_, [](GLFWwindow* handle, int count, const char** paths) {
        Window& window = of(handle);
        window.events_.dropped.insert(window.events_.dropped.end(), paths, paths + count);
    });
}

bool Window::is_closing() const
{
    return glfwWindowShouldClose(handle_) == GLFW_TRUE;
}

bool Window::is_minimised() const
{
    return glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE;
}

void Window::close()
{
    glfwSetWindowShouldClose(handle_, GLFW_TRUE);
}

void Window::set_title(const std::string& title)
{
    glfwSetWindowTitle(handle_, title.c_str());
}

WindowEvents Window::wait(double seconds)
{
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(events_, {});
}

void Window::wake()
{
    if (is_open) {
        glfwPostEmptyEvent();
    }
}

bool Window::is_down(int key) const
{
    return !ImGui::GetIO().WantTextInput && glfwGetKey(handle_, key) == GLFW_PRESS;
}

Gamepad Window::gamepad() const
{
    Gamepad pad;
    if (!has_focus()) {
        return pad;
    }
    GLFWgamepadstate state;
    int number = GLFW_JOYSTICK_1;
    while (number <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(number, &state) != GLFW_TRUE) {
        ++number;
    }
    if (number > GLFW_JOYSTICK_LAST) {
        return pad;
    }
    const auto stick = [&](int x, int y) {
        // Deflections of a gamepad's stick below this value count as 0, because sticks do not return exactly
        // to their middle.
        constexpr double dead = 0.16;
        const glm::dvec2 at(state.axes[x], state.axes[y]);
        const double length = glm::length(at);
        return length > dead ? at / length * std::min((length - dead) / (1.0 - dead), 1.0) : glm::dvec2(0.0);
    };
    pad.walk = stick(GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_LEFT_Y);
    pad.look = stick(GLFW_GAMEPAD_AXIS_RIGHT_X, GLFW_GAMEPAD_AXIS_RIGHT_Y);
    pad.runs = state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] == GLFW_PRESS ||
               state.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] == GLFW_PRESS ||
               state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_THUMB] == GLFW_PRESS;
    pad.jumps = state.buttons[GLFW_GAMEPAD_BUTTON_A] == GLFW_PRESS;
    return pad;
}

void Window::take_pointer(bool is_taken)
{
    glfwSetInputMode(handle_, GLFW_CURSOR, is_taken ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

bool Window::has_focus() const
{
    return glfwGetWindowAttrib(handle_, GLFW_FOCUSED) == GLFW_TRUE;
}

void Window::toggle_full_screen()
{
    if (glfwGetWindowMonitor(handle_) != nullptr) {
        glfwSetWindowMonitor(handle_, nullptr, place_px_.x, place_px_.y, place_px_.z, place_px_.w,
                             GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(handle_, &place_px_.x, &place_px_.y);
    glfwGetWindowSize(handle_, &place_px_.z, &place_px_.w);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    GLFWmonitor** const best = std::max_element(monitors, monitors + count, [&](auto* a, auto* b) {
        return shared_px(place_px_, a) < shared_px(place_px_, b);
    });
    if (count > 0) {
        const GLFWvidmode* mode = glfwGetVideoMode(*best);
        glfwSetWindowMonitor(handle_, *best, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
}

} // namespace estampe::viewer
