// SPDX-License-Identifier: MIT
#pragma once

// The thread that owns the renderer. The thread draws the requested pictures, and runs jobs between pictures.

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <estampe/film.hpp>
#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "viewer/scene_loader.hpp"
#include "worlds.hpp"

namespace estampe::viewer {

/// The settings of a picture that the thread should draw.
struct PictureRequest {
    Camera camera;
    app::ChosenStyle style;
    RenderSettings settings;
    double scale = 1.0; ///< Size of the picture as a share of the view's sides
    uint64_t view = 0;  ///< Number of the view, by which the caller identifies it
};

/// A picture that the thread has drawn.
struct Picture {
    size_t slot = 0;
    Image image;
    double scale = 1.0;
    uint32_t samples = 1;
    uint64_t view = 0;
    Continuity continuity = Continuity::still;
    double seconds = 0.0;
    std::vector<PassTiming> timings;
    std::vector<std::string> notes;
};

/// Changes of the scene since the last picture was requested.
struct SceneChange {
    std::vector<TrailStamp> prints; ///< Footprints to press into the terrain
    /// Time at which the walker reaches the end of the world, so that its last scene begins.
    std::optional<double> end_s;
};

/// Message of the thread: the renderer has another scene.
struct SceneTaken {
    std::shared_ptr<const LoadedFile> file;
};

/// Message of the thread: the renderer has another terrain, or the compiled shader of a terrain that it
/// interpreted until then.
struct TerrainTaken {
    bool is_compiled = false;
};

struct DeviceOpened {
    std::string name;
    bool is_processor = false;
};

/// Message of the thread: an action failed; the previous state is kept.
struct Failure {
    enum class Of : uint8_t { device, scene, terrain, picture, job };
    Of what = Of::picture;
    std::string message;
};

/// Message of the thread: the progress of a job, such as a film.
struct JobNews {
    std::string text;
    double share = 1.0;
    bool is_done = true;
};

using PictureNews = std::variant<Picture, SceneTaken, TerrainTaken, DeviceOpened, Failure, JobNews>;

/// A task that takes longer than a picture and is done in steps. No pictures are drawn until step() returns
/// false. An exception in a step ends the job and becomes a message.
class PictureJob {
public:
    PictureJob() = default;
    virtual ~PictureJob() = default;
    PictureJob(const PictureJob&) = delete;
    PictureJob& operator=(const PictureJob&) = delete;
    /// Does one part of the job. `animator` animates the renderer's scene. Returns whether there is more to
    /// do.
    virtual bool step(Renderer& renderer, app::WorldAnimator& animator,
                      const std::function<void(PictureNews)>& tell) = 0;
};

/// Draws pictures in a separate thread, so that the window never waits for them. The thread has two slots for
/// requests of pictures. In each slot only the newest request is drawn, and the thread alternates between the
/// slots.
class PictureThread {
public:
    /// Starts the thread, which opens the renderer. The thread calls `wake` when there is a message.
    PictureThread(RendererOptions options, std::function<void()> wake);
    /// Waits until the current sample is finished, then ends the thread.
    ~PictureThread();
    PictureThread(const PictureThread&) = delete;
    PictureThread& operator=(const PictureThread&) = delete;

    void set_scene(std::shared_ptr<const LoadedFile> file);
    /// Replaces the terrain from the next picture on. While the terrain's shader is being compiled, a slower
    /// interpreter draws the terrain. After several calls the newest terrain is used. Applies only to the
    /// current scene.
    void set_terrain(const Terrain& terrain);
    /// Applies a change of the scene with the next picture. If that picture is not drawn, its change is added
    /// to the next one.
    void change(SceneChange change);
    /// Replaces the request for a picture in one of the two slots, even if the old request is being drawn and
    /// has samples left. An empty request ends the drawing for the slot.
    void draw(size_t slot, std::optional<PictureRequest> request);
    void do_job(std::unique_ptr<PictureJob> job);
    /// Ends the current job after its current step.
    void cancel_job();
    [[nodiscard]] std::vector<PictureNews> take_news();

private:
    void work();
    void work_on(Renderer& renderer);
    void tell(PictureNews news);
    void take_scene(Renderer& renderer, const std::shared_ptr<const LoadedFile>& file);
    void take_terrain(Renderer& renderer, const Terrain& terrain);
    /// Waits until the thread has something to do.
    void wait(Renderer& renderer, std::unique_lock<std::mutex>& lock);
    /// Returns whether the picture that is being drawn in `slot` is still requested.
    [[nodiscard]] bool is_wanted(size_t slot);
    void apply(Renderer& renderer, const SceneChange& change);
    void draw_picture(Renderer& renderer, size_t slot, const PictureRequest& request);
    void do_step(Renderer& renderer);

    RendererOptions options_;
    std::function<void()> wake_;
    mutable std::mutex guard_;
    std::condition_variable changed_;
    std::shared_ptr<const LoadedFile> next_scene_;
    std::optional<Terrain> next_terrain_;
    SceneChange change_;
    std::array<std::optional<PictureRequest>, 2> requests_;
    size_t next_slot_ = 0;
    std::unique_ptr<PictureJob> job_;
    /// Size of the last picture, if another picture of a film can follow; only used by the thread.
    glm::uvec2 film_size_px_{0};
    bool is_job_cancelled_ = false;
    bool is_closing_ = false;
    std::vector<PictureNews> news_;
    std::shared_ptr<const LoadedFile> scene_;      ///< Scene that the renderer has; only used by the thread
    std::unique_ptr<app::WorldAnimator> animator_; ///< Animator of `scene_`; only used by the thread
    std::optional<Terrain> terrain_; ///< Terrain that replaces the scene's terrain; only used by the thread
    bool is_compiling_ = false;      ///< The terrain's shader is being compiled; only used by the thread
    std::thread thread_;
};

/// A recording of the view. The recording stores camera, time and style, not pictures. A film made from the
/// recording therefore has full quality, however slowly the view was drawn.
class Take {
public:
    struct Sample {
        double at_s = 0.0; ///< Time of the sample since the start of the recording
        Camera camera;
        double time_s = 0.0; ///< Time of the scene's animation
        Index animation = 0;
        std::shared_ptr<const app::ChosenStyle> style;
    };

    /// Adds a sample to the recording. Samples must be added in the order of time.
    void add(Sample sample) { samples_.push_back(std::move(sample)); }

    [[nodiscard]] bool empty() const { return samples_.empty(); }

    [[nodiscard]] double length_s() const { return samples_.empty() ? 0.0 : samples_.back().at_s; }

    /// Returns the recorded view at a time. The camera is interpolated linearly between two samples. The
    /// animation's time is interpolated too, if it increased. All values except camera and time are those of
    /// the earlier of the two samples. Requires at least one sample.
    [[nodiscard]] Sample at(double seconds) const;

private:
    std::vector<Sample> samples_;
};

/// Returns the first file name of the series "fox-001.png", "fox-002.png", ... that does not exist in the
/// working directory.
[[nodiscard]] std::string free_name(const std::string& scene, const std::string& extension);

/// Draws the current view once more, in the same way as `estampe render`, and writes the picture as PNG.
class ScreenshotJob : public PictureJob {
public:
    ScreenshotJob(PictureRequest request, std::string path)
        : request_(std::move(request)), path_(std::move(path))
    {
    }

    bool step(Renderer& renderer, app::WorldAnimator& animator,
              const std::function<void(PictureNews)>& tell) override;

private:
    PictureRequest request_;
    std::string path_;
};

/// Draws a recording as a film, one frame per step.
class FilmJob : public PictureJob {
public:
    /// Prepares a film of a recording; a world is animated from its beginning. `end_s` is the time at which
    /// the walker reached the end of the world.
    FilmJob(Take take, std::shared_ptr<const LoadedFile> file, std::optional<double> end_s,
            RenderSettings settings, std::string path);

    bool step(Renderer& renderer, app::WorldAnimator& animator,
              const std::function<void(PictureNews)>& tell) override;

private:
    void begin(const app::WorldAnimator& seen);

    Take take_;
    std::shared_ptr<const LoadedFile> file_;
    std::optional<double> end_s_;
    std::unique_ptr<app::WorldAnimator> animator_; ///< Animator of the film's scene; set after the first step
    RenderSettings settings_;
    std::string path_;
    uint32_t next_ = 0;
    uint32_t count_;
    std::optional<FilmWriter> writer_;
};

} // namespace estampe::viewer
