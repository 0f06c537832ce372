// SPDX-License-Identifier: MIT
#pragma once

// All that the viewer holds in its hands and its panels show and change. Nothing here knows of windows.

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clock.hpp"
#include "viewer/bookmarks.hpp"
#include "viewer/camera_rig.hpp"
#include "viewer/keys.hpp"
#include "viewer/look.hpp"
#include "viewer/resolution.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/terrain_edit.hpp"
#include "viewer/timeline.hpp"

namespace estampe::viewer {

/// A line for the person before the screen. What went wrong stays until it is closed or put right.
struct Message {
    enum class Kind : uint8_t { note, problem };
    Kind kind = Kind::note;
    std::string topic; ///< what it is about: a later one takes its place
    std::string text;
    app::Clock::time_point since = app::Clock::now();
};

enum class PanelTab : uint8_t { style, light, ground, layers, views, timings };

/// Two looks side by side.
struct Comparison {
    std::optional<Style> other; ///< the one on the right; nothing: there is no comparison
    float split = 0.5F;         ///< share of the width that is the style in hand's
};

/// What is being drawn that takes its time.
struct Work {
    std::string text;
    double share = 0.0;
};

struct Studio {
    explicit Studio(const std::string& style_name, Style style) : look(style_name, std::move(style)) {}

    std::shared_ptr<const LoadedFile> file; ///< what is seen; none before the first is read
    Look look;
    std::optional<TerrainEdit> terrain; ///< that the scene stands on, if it does
    CameraRig rig;
    Timeline time;
    Resolution resolution;
    std::optional<UpAxis> up; ///< axis of the scene's file that points up; none: what the file says
    Comparison comparison;
    std::vector<Bookmark> bookmarks;
    std::optional<size_t> bookmark; ///< the one that was gone to last
    std::deque<Message> messages;
    std::string device;
    bool is_on_processor = false;
    uint32_t samples = 1;

    // The picture that is shown, and how it came about.
    double shown_scale = 0.0;
    glm::uvec2 shown_px{0};
    glm::uvec2 view_px{0}; ///< the whole view
    double shown_s = 0.0;
    bool is_refined = false;
    std::vector<PassTiming> passes;
    std::deque<float> frame_ms; ///< of the last pictures
    std::optional<Work> work;   ///< reading a scene, drawing a film
    bool is_recording = false;
    double recorded_s = 0.0;

    // What is open.
    bool shows_panel = false;
    bool shows_keys = false;
    bool shows_bars = true;
    PanelTab tab = PanelTab::style;
    bool wants_tab = false;    ///< `tab` was chosen by a key
    bool wants_search = false; ///< the cursor goes to the search
    bool wants_save = false;   ///< the cursor goes to the name to save as
    std::string search;
    std::string save_name;
    std::string terrain_save_name;

    /// Says something in place of what was said about `topic` before.
    void say(Message::Kind kind, const std::string& topic, const std::string& text);
    /// What was wrong with `topic` is right.
    void settle(const std::string& topic);
    /// Does `step`; what it throws is said.
    void attempt(const std::string& topic, const std::function<void()>& step);

    /// Of the view, as it is now, in place of what was chosen by number.
    void add_bookmark();
    void go_to_bookmark(size_t index);
    void remove_bookmark(size_t index);
    /// The one before or after, around.
    void step_bookmark(int step);
    /// The next axis of the file points up: z, x, y, around.
    void step_up_axis();
    /// The preset before or after, around.
    void step_preset(int step);
    /// The style in hand becomes the right side, and is compared with what comes of it; or no more.
    void toggle_comparison();
    /// Writes the terrain to that file, and says so.
    void save_terrain(const std::string& path);
    /// Whether keys are for the terrain: undo, redo, save.
    [[nodiscard]] bool is_at_terrain() const;
    void turn_sun(const glm::dvec2& drag);

private:
    void store_bookmarks();
};

} // namespace estampe::viewer
