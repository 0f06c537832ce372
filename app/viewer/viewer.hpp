// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "viewer/camera_rig.hpp"
#include "viewer/panels.hpp"
#include "viewer/picture_thread.hpp"
#include "viewer/reload.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/studio.hpp"
#include "viewer/ui_painter.hpp"
#include "viewer/warm_up.hpp"
#include "viewer/window.hpp"

namespace estampe::viewer {

/// Everything in the view that a picture depends on; a new picture is requested when any of it changes.
struct Sight {
    Camera camera;
    uint64_t style = 0; ///< Revision of the style, EditedStyle::revision()
    double time_s = 0.0;
    Index animation = 0;
    glm::uvec2 size_px{0};
    uint64_t scene = 0;
    uint64_t terrain = 0;      ///< Revision of the terrain, TerrainEdit::revision()
    bool has_other = false;    ///< Another style is shown beside the edited style
    bool times_passes = false; ///< The panel of timings is open
};

/// The viewer's window: passes keys and pointer events to the studio, and shows its pictures.
class Viewer {
public:
    /// Opens the viewer's window and starts to load the scene, if one is named. Throws Error when there is no
    /// display or no device.
    explicit Viewer(const app::ViewCommand& command);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// Runs the viewer until the window is closed. Throws Error when the first scene cannot be read, or the
    /// device is lost.
    void run();

    /// Returns whether a discarded scene is still being loaded; loading cannot be interrupted.
    [[nodiscard]] bool is_reading() const { return loader_->is_busy(); }

private:
    void act(Action action);
    bool act_on_view(Action action);
    bool act_on_style(Action action);
    void go_back();
    void open(const std::string& path);
    /// Opens a scene. `terrain` is the file of the terrain on which the scene is put, unless the scene itself
    /// is a terrain.
    void open_scene(const std::string& path, const std::string& terrain);
    void open_terrain(const std::string& path);
    void open_style(const std::string& name);
    void read_scene_again();
    void take_loaded();
    void take_news();
    void take(Picture& picture);
    void take(const Failure& failure);
    void take(const SceneTaken& taken);
    void take(const TerrainTaken& taken);
    void take_terrain_of(const LoadedFile& file, bool is_same);
    [[nodiscard]] std::optional<double> height_under(const Ground& models, const glm::dvec3& place) const;
    void send_terrain();
    /// Raises or lowers the scene to the height of the terrain, when the terrain below the scene has changed.
    void stand_on_terrain();
    void raise_camera(double rise_m);
    /// Moves the camera up, if the edited terrain has risen above the camera.
    void unbury_camera();
    void ask_for_pictures();
    void request(size_t slot, const Sight& sight, bool is_moving);
    [[nodiscard]] Sight sight() const;
    void move_by_keys(double seconds);
    /// Returns whether the user walks with collision detection.
    [[nodiscard]] bool is_on_foot() const;
    /// Starts a walk at the place where the world's visit begins.
    void set_out();
    void go_on_foot(double seconds);
    /// Hides the pointer and lets it turn the view, or shows it again.
    void take_pointer(bool is_taken);
    void follow_pointer(const std::vector<PointerEvent>& events);
    void press(const PointerEvent& event, const Area& area);
    void drag(const glm::dvec2& way, const PointerEvent& event, const Area& area);
    void look_at_files();
    void look_at_terrain();
    void take_shaders();
    void take_screenshot();
    void toggle_recording();
    void record();
    void lay_out();
    void paint_pictures(const Area& area);
    void paint();
    void apply_scale();
    void report(const std::string& text) const;

    const app::ViewCommand& command_;
    WarmUp warm_up_;
    app::Clock::time_point start_ = app::Clock::now();
    Studio studio_;
    /// The picture thread and the next two members must be destroyed before the window.
    std::optional<PictureThread> pictures_;
    std::optional<SceneLoader> loader_;
    std::optional<ShaderReload> shaders_;
    Window window_;
    Screen screen_;
    UiPainter painter_;
    std::array<std::unique_ptr<Texture>, 2> textures_;
    PanelRequests requests_;
    float ui_scale_ = 0.0F;

    Sight asked_;
    uint64_t view_ = 0; ///< Number of the view that `asked_` describes
    /// For each slot of the picture thread: number of the view that was last requested.
    std::array<uint64_t, 2> requested_view_{};
    std::array<bool, 2> requested_whole_{};
    /// For each slot of the picture thread: number of the view for which a picture or an error last arrived.
    std::array<uint64_t, 2> answered_view_{};
    app::Clock::time_point changed_ = start_; ///< Time when the view last changed
    uint64_t scene_number_ = 0;
    uint64_t style_drawn_ = 0;
    bool is_moving_ = false;
    bool has_painted_picture_ = false;

    enum class Drag : uint8_t { none, turn, pan, zoom, sun, split };
    Drag drag_ = Drag::none;
    glm::dvec2 pointer_{0.0};
    bool has_pointer_ = false;
    glm::dvec3 walked_to_{0.0};   ///< Position of the eye after the last step in walk mode
    std::optional<double> end_s_; ///< Time when the walker reached the end of a world
    FileWatch scene_watch_;
    FileWatch style_watch_;
    FileWatch terrain_watch_;
    std::string watched_style_;
    std::vector<std::filesystem::path> watched_terrain_;
    /// Revision of the terrain that was last sent to the renderer, TerrainEdit::revision().
    uint64_t terrain_sent_ = 0;
    double standing_m_ = 0.0; ///< Height of the scene's origin when the scene was last put on the terrain
    app::Clock::time_point looked_at_files_ = start_;
    Take take_;
    app::Clock::time_point take_start_ = start_;
    std::shared_ptr<const app::ChosenStyle> take_style_;
    uint64_t take_revision_ = 0;
    /// Number of frames to paint; panels need a few frames until their layout is stable.
    int frames_to_paint_ = 3;
};

} // namespace estampe::viewer
