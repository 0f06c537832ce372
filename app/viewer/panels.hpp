// SPDX-License-Identifier: MIT
#pragma once

// What Dear ImGui lays out around and over the picture.

#include <functional>
#include <optional>
#include <string>

#include "style/parameter.hpp"
#include "style/schema.hpp"
#include "viewer/studio.hpp"

namespace estampe::viewer {

/// Colours, distances and font of all panels, for a display of so many pixels a point.
void apply_theme(float content_scale);

/// What panels ask for beyond changing the studio.
struct PanelRequests {
    std::function<void(Action)> act; ///< as if a key had been pressed
    std::function<void(const std::string&)> open_style;
    std::function<void()> cancel_work;
};

/// What the panels leave of the window for the picture, in pixels.
struct Area {
    float x = 0.0F;
    float y = 0.0F;
    float width = 0.0F;
    float height = 0.0F;
};

// One each, called every time the window is painted, within ImGui's frame.

/// The area that is left for the picture, from what is open.
[[nodiscard]] Area picture_area(const Studio& studio, float content_scale);

void show_bar(Studio& studio, const PanelRequests& requests, float content_scale);
void show_panel(Studio& studio, const PanelRequests& requests, float content_scale);
void show_messages(Studio& studio, const PanelRequests& requests, const Area& area, float content_scale);
void show_keys(Studio& studio, const Area& area, float content_scale);

// The tabs of the panel.
void show_style_tab(Studio& studio, const PanelRequests& requests);
void show_light_tab(Studio& studio);
void show_ground_tab(Studio& studio, const PanelRequests& requests);
void show_layers_tab(Studio& studio);
void show_views_tab(Studio& studio, const PanelRequests& requests);
void show_timings_tab(Studio& studio);

/// Rows of parameters: one that its table describes, with name, control and a way back to the base.
/// Those of the sections named, or all; of these such as hold every word of `search`.
void show_parameters(Studio& studio, const std::string& search, std::span<const char* const> sections);

/// Whether each word of `search` is found in the name of the parameter, its section or its help.
[[nodiscard]] bool matches(const style::Section& section, const style::Parameter& parameter,
                           const std::string& search);

/// Whether any parameter of the section matches.
[[nodiscard]] bool matches(const style::Section& section, const std::string& search);

/// What a person did to a row.
struct RowEdit {
    std::optional<style::Value> value; ///< another one
    bool is_finished = false;          ///< a drag at its end, what is picked or typed at once
};

/// A line of a panel: the name of a parameter, a control of its kind, and a way back to `base` where it
/// differs.
[[nodiscard]] RowEdit show_parameter_row(const std::string& section, const style::Parameter& parameter,
                                         const style::Value& held, const style::Value& base);

} // namespace estampe::viewer
