// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace estampe::viewer {

/// What a key asks for.
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
    none, ///< a line of the list that is no command: what the pointer does
};

/// One line of the list of keys.
struct KeyHelp {
    Action action;
    int key;       ///< GLFW_KEY_*, or a letter that is typed, in which case the layout of the keyboard counts
    int modifiers; ///< GLFW_MOD_*
    const char* name; ///< "Ctrl+Z"
    const char* help;
};

/// A heading and its lines, as the overlay, --help and the manual list them.
struct KeyGroup {
    const char* title;
    std::span<const KeyHelp> keys;
};

[[nodiscard]] std::span<const KeyGroup> key_groups();

/// What a key that went down asks for.
[[nodiscard]] std::optional<Action> action_of_key(int key, int modifiers);
/// What a typed letter asks for.
[[nodiscard]] std::optional<Action> action_of_letter(char32_t letter);

/// All of it as text, a line a key.
[[nodiscard]] std::string keys_text();

} // namespace estampe::viewer
