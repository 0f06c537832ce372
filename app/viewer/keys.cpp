// SPDX-License-Identifier: MIT
#include "viewer/keys.hpp"

#include <array>

#include <fmt/format.h>

#include "viewer/screen.hpp"

namespace estampe::viewer {
namespace {

// Value of KeyHelp::modifiers for a typed letter: any modifier keys may be held, because some keyboard
// layouts need them for the letter.
constexpr int as_typed = -1;

constexpr std::array pointer_keys{
    KeyHelp{Action::none, 0, 0, "Left drag", "orbit around the model; look around when flying or walking"},
    KeyHelp{Action::none, 0, 0, "Shift+drag, middle drag", "pan the view"},
    KeyHelp{Action::none, 0, 0, "Wheel, right drag", "move closer or farther away"},
    KeyHelp{Action::none, 0, 0, "L+drag", "turn the sun"},
    KeyHelp{Action::none, 0, 0, "Files dropped", "open a scene, a style, a terrain or a tonal art map"}};

constexpr std::array camera_keys{
    KeyHelp{Action::orbit, 'o', as_typed, "O", "orbit around the model"},
    KeyHelp{Action::fly, 'f', as_typed, "F", "fly: W A S D, E up, C down, Shift faster"},
    KeyHelp{Action::walk, 'g', as_typed, "G", "walk on the ground: W A S D, Shift faster"},
    KeyHelp{Action::none, 0, 0, "On foot in a world",
            "also arrow keys or a gamepad; Space jumps; a click captures the pointer"},
    KeyHelp{Action::home, GLFW_KEY_ENTER, 0, "Enter", "return to the first view"},
    KeyHelp{Action::front, '1', as_typed, "1", "look from the front"},
    KeyHelp{Action::back_side, GLFW_KEY_1, GLFW_MOD_CONTROL, "Ctrl+1", "look from the back"},
    KeyHelp{Action::right, '3', as_typed, "3", "look from the right"},
    KeyHelp{Action::left, GLFW_KEY_3, GLFW_MOD_CONTROL, "Ctrl+3", "look from the left"},
    KeyHelp{Action::top, '7', as_typed, "7", "look from above"},
    KeyHelp{Action::bottom, GLFW_KEY_7, GLFW_MOD_CONTROL, "Ctrl+7", "look from below"},
    KeyHelp{Action::isometric, '9', as_typed, "9", "look from a corner"},
    KeyHelp{Action::projection, '5', as_typed, "5", "switch parallel projection on or off"},
    KeyHelp{Action::up_axis, 'z', as_typed, "Z", "choose the axis of the file that points up: z, x, y"},
    KeyHelp{Action::roll_left, '4', as_typed, "4", "roll to the left"},
    KeyHelp{Action::roll_right, '6', as_typed, "6", "roll to the right"},
    KeyHelp{Action::add_bookmark, 'm', as_typed, "M", "save this view as a bookmark"},
    KeyHelp{Action::bookmark_back, GLFW_KEY_PAGE_UP, 0, "Page up", "go to the previous bookmark"},
    KeyHelp{Action::bookmark_on, GLFW_KEY_PAGE_DOWN, 0, "Page down", "go to the next bookmark"}};

constexpr std::array style_keys{
    KeyHelp{Action::toggle_panel, GLFW_KEY_TAB, 0, "Tab",
            "show or hide the panel: style, light, ground, layers, views, timings"},
    KeyHelp{Action::search, GLFW_KEY_F, GLFW_MOD_CONTROL, "Ctrl+F", "search the parameters of the style"},
    KeyHelp{Action::undo, GLFW_KEY_Z, GLFW_MOD_CONTROL, "Ctrl+Z", "undo the last change"},
    KeyHelp{Action::redo, GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, "Ctrl+Shift+Z",
            "redo the last change"},
    KeyHelp{Action::save_style, GLFW_KEY_S, GLFW_MOD_CONTROL, "Ctrl+S",
            "save the style, or the ground if its tab is open"},
    KeyHelp{Action::style_back, '[', as_typed, "[", "go to the previous preset"},
    KeyHelp{Action::style_on, ']', as_typed, "]", "go to the next preset"},
    KeyHelp{Action::compare, 'b', as_typed, "B",
            "compare later changes with the style as it is now, on or off"}};

constexpr std::array time_keys{
    KeyHelp{Action::play, GLFW_KEY_SPACE, 0, "Space", "play or pause the animation"},
    KeyHelp{Action::frame_back, GLFW_KEY_LEFT, 0, "Left", "go back one frame"},
    KeyHelp{Action::frame_on, GLFW_KEY_RIGHT, 0, "Right", "go on one frame"},
    KeyHelp{Action::next_animation, 'w', as_typed, "W", "play the next animation, in orbit mode"}};

constexpr std::array program_keys{
    KeyHelp{Action::show_keys, '?', as_typed, "?", "show or hide this list"},
    KeyHelp{Action::screenshot, GLFW_KEY_F12, 0, "F12", "write the picture as a PNG file"},
    KeyHelp{Action::record, GLFW_KEY_F10, 0, "F10", "start recording; press again to stop and draw the film"},
    KeyHelp{Action::timings, 't', as_typed, "T", "show or hide the times of all passes"},
    KeyHelp{Action::reload, GLFW_KEY_UP, 0, "Up", "reload the scene"},
    KeyHelp{Action::toggle_bars, 'u', as_typed, "U", "show the picture alone"},
    KeyHelp{Action::toggle_full_screen, GLFW_KEY_F11, 0, "F11", "switch full screen on or off"},
    KeyHelp{Action::back, GLFW_KEY_ESCAPE, 0, "Escape",
            "close what is open or cancel; else quit the program"},
    KeyHelp{Action::quit, 'q', as_typed, "Q", "quit the program"}};

constexpr std::array groups{KeyGroup{"Pointer", pointer_keys}, KeyGroup{"Camera", camera_keys},
                            KeyGroup{"Style", style_keys}, KeyGroup{"Time", time_keys},
                            KeyGroup{"Program", program_keys}};

} // namespace

std::span<const KeyGroup> key_groups()
{
    return groups;
}

std::optional<Action> action_of_key(int key, int modifiers)
{
    constexpr int counted = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT;
    if (key == GLFW_KEY_Y && (modifiers & counted) == GLFW_MOD_CONTROL) {
        return Action::redo;
    }
    if (key == GLFW_KEY_KP_ENTER) {
        return Action::home;
    }
    for (const KeyGroup& group : groups) {
        for (const KeyHelp& help : group.keys) {
            if (help.action != Action::none && help.modifiers != as_typed && help.key == key &&
                help.modifiers == (modifiers & counted)) {
                return help.action;
            }
        }
    }
    return std::nullopt;
}

std::optional<Action> action_of_letter(char32_t typed)
{
    const char32_t small = typed >= U'A' && typed <= U'Z' ? typed + (U'a' - U'A') : typed;
    for (const KeyGroup& group : groups) {
        for (const KeyHelp& help : group.keys) {
            if (help.modifiers == as_typed && static_cast<char32_t>(help.key) == small) {
                return help.action;
            }
        }
    }
    return std::nullopt;
}

std::string keys_text()
{
    std::string text;
    for (const KeyGroup& group : groups) {
        text += fmt::format("{}{}:\n", text.empty() ? "" : "\n", group.title);
        for (const KeyHelp& help : group.keys) {
            text += fmt::format("  {:<30}{}\n", help.name, help.help);
        }
    }
    return text;
}

} // namespace estampe::viewer
