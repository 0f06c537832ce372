// SPDX-License-Identifier: MIT
#pragma once

// Panels of Dear ImGui around and over the picture.

#include <functional>
#include <optional>
#include <string>

#include "style/parameter.hpp"
#include "style/schema.hpp"
#include "viewer/studio.hpp"

namespace estampe::viewer {

/// Sets colours, distances and font of all panels. `content_scale` is the number of pixels per point of the
/// display.
void apply_theme(float content_scale);

/// Callbacks of the window that panels call for actions beyond a change of the studio (the viewer's state).
struct PanelRequests {
    std::function<void(Action)> act; ///< Runs a command as if its key had been pressed
    std::function<void(const std::string&)> open_style;
    std::function<void()> cancel_work;
};

/// The area of the window that is left for the picture, in pixels.
struct Area {
    float x = 0.0F;
    float y = 0.0F;
    float width = 0.0F;
    float height = 0.0F;
};

// Functions that are called every time the window is painted, between ImGui's calls NewFrame and Render.

/// Returns the area of the window that the open panels leave for the picture.
[[nodiscard]] Area picture_area(const Studio& studio, float content_scale);

void show_bar(Studio& studio, const PanelRequests& requests, float content_scale);
void show_panel(Studio& studio, const PanelRequests& requests, float content_scale);
void show_messages(Studio& studio, const PanelRequests& requests, const Area& area, float content_scale);
void show_keys(Studio& studio, const Area& area, float content_scale);

// Functions that each show one tab of the panel.
void show_style_tab(Studio& studio, const PanelRequests& requests);
void show_light_tab(Studio& studio);
void show_ground_tab(Studio& studio, const PanelRequests& requests);
void show_layers_tab(Studio& studio);
void show_views_tab(Studio& studio, const PanelRequests& requests);
void show_timings_tab(Studio& studio);

/// Shows a row for each parameter of the named sections, or of all sections: name, control and a reset
/// button. Only rows that contain every word of `search` are shown.
void show_parameters(Studio& studio, const std::string& search, std::span<const char* const> sections);

/// Returns whether each word of `search` occurs in the name, the section or the help of the parameter.
[[nodiscard]] bool matches(const style::Section& section, const style::Parameter& parameter,
                           const std::string& search);

/// Returns whether `search` matches any parameter of the section.
[[nodiscard]] bool matches(const style::Section& section, const std::string& search);

/// The change that the user made in a row of a panel.
struct RowEdit {
    std::optional<style::Value> value; ///< New value of the parameter, if it changed
    bool is_finished = false; ///< The change is complete: a drag has ended, or a value was picked or typed
};

/// Shows a row of a panel: the name of a parameter, a control for its kind of value, and a reset button. The
/// button sets the parameter to its value in `base`, if the values differ.
[[nodiscard]] RowEdit show_parameter_row(const std::string& section, const style::Parameter& parameter,
                                         const style::Value& held, const style::Value& base);

} // namespace estampe::viewer
