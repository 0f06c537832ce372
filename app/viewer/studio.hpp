// SPDX-License-Identifier: MIT
#pragma once

// State of the viewer that its panels show and change; independent of windows.

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

#include "confine.hpp"
#include "messages.hpp"
#include "viewer/camera_rig.hpp"
#include "viewer/history.hpp"
#include "viewer/keys.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/terrain_edit.hpp"

namespace estampe::viewer {

/// Chooses the size of pictures while something moves, as a share of the view's sides: the largest size that
/// reaches 15 pictures per second.
class Resolution {
public:
    static constexpr double wanted_s = 1.0 / 15.0;
    static constexpr double least = 0.125;

    [[nodiscard]] double scale() const { return scale_; }

    /// Reports that a picture of the size `scale` took `seconds`. A single slow picture, as when the driver
    /// compiles, changes nothing.
    void drawn(double scale, double seconds);

private:
    double scale_ = 0.25; ///< Size of the next picture; small at first, so that the first picture comes soon
    double slow_s_ = 0.0; ///< Drawing time of the previous picture if it was too slow
};

/// The time of the scene's animation that is shown, and how the animation is played.
struct Timeline {
    double time_s = 0.0;
    double length_s = 0.0; ///< Length of the animation; 0: nothing moves
    double speed = 1.0;
    bool is_playing = false;
    bool loops = true;
    bool is_endless = false; ///< The scene moves forever, without a loop
    Index animation = 0;

    [[nodiscard]] bool moves() const { return is_endless || length_s > 0.0; }

    /// Advances the animation by wall time while it is playing. At the end, if there is one, starts again or
    /// stops.
    void advance(double seconds);
    /// Moves to a time of the animation, which is clamped to its range.
    void seek(double moment_s);
    void toggle_playing();
};

/// A bookmark: a view that the user saved.
struct Bookmark {
    std::string name;
    Camera camera;
    double time_s = 0.0;
    Index animation = 0;
};

/// Returns the path of the file with a scene's bookmarks: beside the scene, as "helmet.gltf.views.json".
[[nodiscard]] std::filesystem::path bookmarks_path(const std::filesystem::path& scene);

/// Reads the bookmarks of a file; none if the file does not exist. Throws Error when the file is damaged.
[[nodiscard]] std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path,
                                                   const ReadScope& scope = {});

/// Writes all bookmarks atomically; deletes the file if there are none. Throws Error when the file cannot be
/// written.
void save_bookmarks(const std::vector<Bookmark>& bookmarks, const std::filesystem::path& path);

/// The style that the user edits, with its source and undo history.
class EditedStyle {
public:
    /// Starts to edit a style. `name` is the preset or file of the command line; `style` includes the changes
    /// of --set. An empty name means the built-in style. `confine` limits the files that are read.
    EditedStyle(const std::string& name, Style style, app::Confinement confine = {});

    [[nodiscard]] const Style& style() const { return style_; }

    /// Returns the edited style. The caller may change the style through the reference; finish_change() then
    /// adds an undo step.
    [[nodiscard]] Style& style() { return style_; }

    /// Returns whether the style's preset or file differs from the one that was read before.
    [[nodiscard]] bool differs_from_file() const;

    /// Returns the unchanged preset or file, to which parameters are reset.
    [[nodiscard]] const Style& base() const { return base_; }

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Loads a preset or file as one undo step. Throws Error as Style::load() does, and then changes nothing.
    void load(const std::string& name);
    /// Applies the assignment "key=value" as one undo step. Throws Error as Style::set() does.
    void set(std::string_view assignment);
    void finish_change();
    /// Calls finish_change() if any parameter changed since the last undo step.
    void finish_change_if_any();

    [[nodiscard]] bool can_undo() const { return history_.can_undo(); }

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    void undo();
    void redo();

    /// Writes all parameters of the style atomically as a TOML file, which becomes the style's source. Throws
    /// Error when the file cannot be written.
    void save(const std::filesystem::path& path);

    /// Returns a number that increases with every change of the style.
    [[nodiscard]] uint64_t revision() const { return revision_; }

    void changed() { ++revision_; }

private:
    struct State {
        std::string name;
        Style base;
        Style style;
    };

    void take(const State& state);

    app::Confinement confine_;
    std::string name_;
    Style base_;
    Style style_;
    History<State> history_;
    uint64_t revision_ = 0;
    uint64_t finished_revision_ = 0; ///< Revision of the style at the last undo step
};

/// A message (one line of text) for the user. A message about a problem stays until the user closes it or the
/// problem is solved.
struct Message {
    enum class Kind : uint8_t { note, problem };
    Kind kind = Kind::note;
    std::string topic; ///< Subject of the message; a later message about the same subject replaces this one
    std::string text;
    app::Clock::time_point since = app::Clock::now();
};

enum class PanelTab : uint8_t { style, light, ground, layers, views, timings };

/// Comparison of two styles, shown side by side.
struct Comparison {
    std::optional<Style> other; ///< Style on the right side; nothing when comparing is off
    float split = 0.5F;         ///< Share of the view's width that shows the edited style
};

/// A long task of the viewer that is in progress.
struct Work {
    std::string text;
    double share = 0.0;
};

struct Studio {
    explicit Studio(const std::string& style_name, Style style, app::Confinement confine = {})
        : edited(style_name, std::move(style), std::move(confine))
    {
    }

    std::shared_ptr<const LoadedFile> file; ///< Scene that is shown; null before the first scene is loaded
    EditedStyle edited;
    std::optional<TerrainEdit> terrain; ///< Edited terrain below the scene, if any
    CameraRig rig;
    Timeline time;
    Resolution resolution;
    std::optional<UpAxis> up; ///< Axis of the scene's file that points up; none: taken from the file
    Comparison comparison;
    std::vector<Bookmark> bookmarks;
    std::optional<size_t> bookmark; ///< Number of the bookmark that was chosen last
    std::deque<Message> messages;
    std::string device;
    bool is_on_processor = false;
    uint32_t samples = 1;

    // Size of the shown picture, as a share of the view's sides. The fields below also describe the shown
    // picture.
    double shown_scale = 0.0;
    glm::uvec2 shown_px{0};
    glm::uvec2 view_px{0}; ///< Size of the whole view in pixels
    double shown_s = 0.0;
    bool is_refined = false;
    std::vector<PassTiming> passes;
    std::deque<float> frame_ms; ///< Drawing times of the last pictures
    std::optional<Work> work;   ///< Long task: loading a scene or drawing a film
    bool is_recording = false;
    double recorded_s = 0.0;

    // State of the panels: which panels are open, and where the text cursor must go.
    bool shows_panel = false;
    bool shows_keys = false;
    bool shows_bars = true;
    PanelTab tab = PanelTab::style;
    bool wants_tab = false;    ///< A key has chosen `tab`, which must be brought to the front
    bool wants_search = false; ///< The text cursor must move to the search field
    bool wants_save = false;   ///< The text cursor must move to the field for the file name
    std::string search;
    std::string save_name;
    std::string terrain_save_name;

    /// Shows a message and removes earlier messages about `topic`.
    void say(Message::Kind kind, const std::string& topic, const std::string& text);
    /// Removes the messages about the subject `topic`, because the problem is solved.
    void settle(const std::string& topic);
    /// Calls `step`, and shows an exception of `step` as a message about `topic`.
    void attempt(const std::string& topic, const std::function<void()>& step);

    /// Bookmarks the current view and deselects the bookmark that was chosen before.
    void add_bookmark();
    void go_to_bookmark(size_t index);
    void remove_bookmark(size_t index);
    /// Goes to the next or previous bookmark, cyclically.
    void step_bookmark(int step);
    /// Makes the next axis of the scene's file point up, in the cycle z, x, y.
    void step_up_axis();
    /// Loads the next or previous preset, cyclically.
    void step_preset(int step);
    /// Copies the current style to the right side for comparison with further changes, or ends the
    /// comparison.
    void toggle_comparison();
    /// Writes the terrain to the given file and shows a message.
    void save_terrain(const std::string& path);
    /// Returns whether the keys for undo, redo and save apply to the terrain.
    [[nodiscard]] bool is_at_terrain() const;
    void turn_sun(const glm::dvec2& drag);

private:
    void store_bookmarks();
};

} // namespace estampe::viewer
