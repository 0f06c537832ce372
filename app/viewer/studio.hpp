// SPDX-License-Identifier: MIT
#pragma once

// All that the viewer holds in its hands and its panels show and change. Nothing here knows of windows.

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "messages.hpp"
#include "viewer/camera_rig.hpp"
#include "viewer/history.hpp"
#include "viewer/keys.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/terrain_edit.hpp"

namespace estampe::viewer {

/// How large pictures are drawn while something moves, as a share of the view's sides: as large as lets 15
/// of them come in a second.
class Resolution {
public:
    static constexpr double wanted_s = 1.0 / 15.0;
    static constexpr double least = 0.125;

    [[nodiscard]] double scale() const { return scale_; }

    /// A picture of `scale` took so long. A single slow one, as when the driver compiles, changes nothing.
    void drawn(double scale, double seconds);

private:
    double scale_ = 0.25; ///< the first picture comes soon
    double slow_s_ = 0.0; ///< what the picture before took, where that was too long
};

/// Where the scene's animation is, and how it goes on.
struct Timeline {
    double time_s = 0.0;
    double length_s = 0.0; ///< 0: nothing moves
    double speed = 1.0;
    bool is_playing = false;
    bool loops = true;
    bool is_endless = false; ///< something moves for ever, and nothing is repeated
    Index animation = 0;

    [[nodiscard]] bool moves() const { return is_endless || length_s > 0.0; }

    /// Plays on by so much of the clock's time. At the end, if there is one, it begins again or stops.
    void advance(double seconds);
    /// To a moment, within the animation.
    void seek(double moment_s);
    void toggle_playing();
};

/// A view that is kept.
struct Bookmark {
    std::string name;
    Camera camera;
    double time_s = 0.0;
    Index animation = 0;
};

/// Where the bookmarks of a scene lie: beside it, as "helmet.gltf.views.json".
[[nodiscard]] std::filesystem::path bookmarks_path(const std::filesystem::path& scene);

/// Those in a file; none where there is no such file. Throws Error when it is broken.
[[nodiscard]] std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path);

/// Writes all of them, or nothing; without any the file goes. Throws Error when it cannot be written.
void save_bookmarks(const std::vector<Bookmark>& bookmarks, const std::filesystem::path& path);

/// The style in hand: where it came from, what was changed, and how to go back.
class Look {
public:
    /// As the command line has it: a preset or a file, changed by --set. An empty name is the built-in style.
    Look(const std::string& name, Style style);

    [[nodiscard]] const Style& style() const { return style_; }

    /// To be changed in place; finish_change() makes a step of it that can be undone.
    [[nodiscard]] Style& style() { return style_; }

    /// What parameters are set back to: the preset or file as it is.
    [[nodiscard]] const Style& base() const { return base_; }

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Takes a preset or file, in one step. Throws Error as Style::load() does, and is then as before.
    void load(const std::string& name);
    /// Applies "key=value", in one step. Throws Error as Style::set() does.
    void set(std::string_view assignment);
    void finish_change();
    /// The same, once for all that was changed since the last step.
    void finish_change_if_any();

    [[nodiscard]] bool can_undo() const { return history_.can_undo(); }

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    void undo();
    void redo();

    /// Writes all parameters as a TOML file, or nothing. It is then the file in hand. Throws Error when it
    /// cannot be written.
    void save(const std::filesystem::path& path);

    /// Grows with every change of the style.
    [[nodiscard]] uint64_t revision() const { return revision_; }

    void changed() { ++revision_; }

private:
    struct State {
        std::string name;
        Style base;
        Style style;
    };

    void take(const State& state);

    std::string name_;
    Style base_;
    Style style_;
    History<State> history_;
    uint64_t revision_ = 0;
    uint64_t finished_revision_ = 0; ///< of the last step
};

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
