// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "viewer/keys.hpp"
#include "viewer/screen.hpp"

namespace estampe::viewer {

/// An event of the pointer: a button, a move or the wheel. Several may arrive between two calls of
/// Window::wait().
struct PointerEvent {
    enum class Kind : uint8_t { press, release, move, wheel };
    Kind kind = Kind::move;
    int button = 0;    ///< Button of the pointer, as GLFW_MOUSE_BUTTON_*
    int modifiers = 0; ///< Modifier keys that were held, as GLFW_MOD_*
    glm::dvec2 place{0.0};
    double wheel = 0.0;
};

/// Events of the window since the last call of Window::wait().
struct WindowEvents {
    std::vector<Action> actions; ///< Commands of the keys that no text field used
    std::vector<std::string> dropped;
    std::vector<PointerEvent> pointer;
    bool any = false; ///< True if any event arrived that may change what the window shows
};

/// State of the first gamepad; sticks are -1 to 1 on each axis, positive to the right and down.
struct Gamepad {
    glm::dvec2 walk{0.0}; ///< Deflection of the left stick
    glm::dvec2 look{0.0}; ///< Deflection of the right stick
    bool runs = false;    ///< A bumper, or the left stick, is pressed
    bool jumps = false;   ///< The lowest of the four face buttons is pressed
};

/// A window of the system with its keys and pointer, and its ImGui context. Only one window can exist at a
/// time.
class Window {
public:
    /// Opens the window. Throws Error when there is no display.
    Window(uint32_t width, uint32_t height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] GLFWwindow* handle() const { return handle_; }

    [[nodiscard]] bool is_closing() const;
    [[nodiscard]] bool is_minimised() const;
    void close();
    void set_title(const std::string& title);

    /// Waits at most this long for events of the window; 0 does not wait.
    [[nodiscard]] WindowEvents wait(double seconds);
    /// Makes the current call of wait() return at once. Any thread may call this function.
    static void wake();

    /// Pixels of the display per point of text size.
    [[nodiscard]] float content_scale() const { return content_scale_; }

    [[nodiscard]] bool is_down(int key) const;
    /// Returns the state of the gamepad, or of a gamepad at rest if there is none.
    [[nodiscard]] Gamepad gamepad() const;
    /// Hides the pointer and lets it move without limit, or shows it again.
    void take_pointer(bool is_taken);
    [[nodiscard]] bool has_focus() const;
    /// Toggles full screen mode, on the monitor that shows the largest part of the window.
    void toggle_full_screen();

private:
    static Window& of(GLFWwindow* handle);
    void watch_keys();
    void watch_rest();

    GLFWwindow* handle_ = nullptr;
    WindowEvents events_;
    /// Position of the pointer after the events processed so far; the real pointer may be ahead.
    glm::dvec2 pointer_{0.0};
    float content_scale_ = 1.0F;
    glm::ivec4 place_px_{0}; ///< x, y, width and height of the window before full screen
};

} // namespace estampe::viewer
