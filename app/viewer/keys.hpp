// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace estampe::viewer {

/// Command of the viewer that a key runs.
enum class Action : uint8_t {
    show_keys,
    toggle_panel,
    toggle_bars,
    toggle_full_screen,
    back,
    quit,
    orbit,
    fly,
    walk,
    home,
    front,
    back_side,
    right,
    left,
    top,
    bottom,
    isometric,
    projection,
    up_axis,
    roll_left,
    roll_right,
    play,
    next_animation,
    frame_back,
    frame_on,
    undo,
    redo,
    search,
    style_back,
    style_on,
    compare,
    save_style,
    timings,
    add_bookmark,
    bookmark_back,
    bookmark_on,
    reload,
    screenshot,
    record,
    none, ///< A line in the list of keys without a command, which describes the pointer
};

/// A line in the list of the viewer's keys.
struct KeyHelp {
    Action action;
    int key;          ///< Key as GLFW_KEY_*, or a typed letter, which depends on the keyboard layout
    int modifiers;    ///< Modifiers that must be held, as GLFW_MOD_*
    const char* name; ///< Name of the key for the user, such as "Ctrl+Z"
    const char* help;
};

/// A heading and its lines in the list of keys, for the overlay, --help and the manual.
struct KeyGroup {
    const char* title;
    std::span<const KeyHelp> keys;
};

[[nodiscard]] std::span<const KeyGroup> key_groups();

/// Returns the command of a key that was pressed.
[[nodiscard]] std::optional<Action> action_of_key(int key, int modifiers);
/// Returns the command of a typed letter.
[[nodiscard]] std::optional<Action> action_of_letter(char32_t letter);

/// Lists all keys as text, one line per key.
[[nodiscard]] std::string keys_text();

} // namespace estampe::viewer
