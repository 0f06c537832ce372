// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace estampe::viewer {

/// Command of a key.
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
    none, ///< a line of the list without a command: describes the pointer
};

/// One line of the list of keys.
struct KeyHelp {
    Action action;
    int key;          ///< GLFW_KEY_*, or a typed letter, which depends on the keyboard layout
    int modifiers;    ///< GLFW_MOD_*
    const char* name; ///< "Ctrl+Z"
    const char* help;
};

/// A heading and its lines in the overlay, --help and the manual.
struct KeyGroup {
    const char* title;
    std::span<const KeyHelp> keys;
};

[[nodiscard]] std::span<const KeyGroup> key_groups();

/// The action of a key that was pressed.
[[nodiscard]] std::optional<Action> action_of_key(int key, int modifiers);
/// The action of a typed letter.
[[nodiscard]] std::optional<Action> action_of_letter(char32_t letter);

/// All keys as text, one line per key.
[[nodiscard]] std::string keys_text();

} // namespace estampe::viewer
