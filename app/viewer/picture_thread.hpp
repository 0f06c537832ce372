// SPDX-License-Identifier: MIT
#pragma once

// The thread that owns the renderer: pictures that it is asked for, and jobs that it does between them.

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

/// One picture to be drawn.
struct PictureRequest {
    Camera camera;
    app::ChosenStyle style;
    RenderSettings settings;
    double scale = 1.0; ///< share of the view's sides that the settings' size is
    uint64_t view = 0;  ///< number of what is to be seen, for whoever asks
};

/// One that was.
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

/// What has become of the scene since the last picture.
struct SceneChange {
    std::vector<TrailStamp> prints; ///< in its terrain
    std::optional<double> end_s;    ///< its world comes to its end from that moment on
};

/// The renderer has another scene.
struct SceneTaken {
    std::shared_ptr<const LoadedFile> file;
};

/// The renderer has another ground, or the shader of one that it had interpreted until then.
struct TerrainTaken {
    bool is_compiled = false;
};

struct DeviceOpened {
    std::string name;
    bool is_processor = false;
};

/// Something went wrong; all is as it was before.
struct Failure {
    enum class Of : uint8_t { device, scene, terrain, picture, job };
    Of what = Of::picture;
    std::string message;
};

/// What a job reports, such as a film how far it is.
struct JobNews {
    std::string text;
    double share = 1.0;
    bool is_done = true;
};

using PictureNews = std::variant<Picture, SceneTaken, TerrainTaken, DeviceOpened, Failure, JobNews>;

/// Something longer than a picture, in steps: the renderer draws nothing else until its step says false.
/// What a step throws ends it and is news.
class PictureJob {
public:
    PictureJob() = default;
    virtual ~PictureJob() = default;
    PictureJob(const PictureJob&) = delete;
    PictureJob& operator=(const PictureJob&) = delete;
    /// Does a part; `animator` is that of the scene on the renderer. Returns whether there is more.
    virtual bool step(Renderer& renderer, app::WorldAnimator& animator,
                      const std::function<void(PictureNews)>& tell) = 0;
};

/// Draws in a thread of its own, so that nothing waits for pictures: of those asked for the newest is drawn,
/// one of two slots after the other.
class PictureThread {
public:
    /// Opens the renderer. `wake` is called from the thread when there is news.
    PictureThread(RendererOptions options, std::function<void()> wake);
    /// Waits for the sample in hand.
    ~PictureThread();
    PictureThread(const PictureThread&) = delete;
    PictureThread& operator=(const PictureThread&) = delete;

    void set_scene(std::shared_ptr<const LoadedFile> file);
    /// Gives the scene another ground, from the next picture on; an interpreter draws it until its shader is
    /// compiled. Of several the newest counts, for this scene alone.
    void set_terrain(const Terrain& terrain);
    /// Seen in the next picture; nothing of it is lost when that is not drawn.
    void change(SceneChange change);
    /// In place of what was asked for in that slot, even if it is begun and has samples to come. Nothing: no
    /// more.
    void draw(size_t slot, std::optional<PictureRequest> request);
    void do_job(std::unique_ptr<PictureJob> job);
    /// Ends the job in hand after its step.
    void cancel_job();
    [[nodiscard]] std::vector<PictureNews> take_news();

private:
    void work();
    void work_on(Renderer& renderer);
    void tell(PictureNews news);
    void take_scene(Renderer& renderer, const std::shared_ptr<const LoadedFile>& file);
    void take_terrain(Renderer& renderer, const Terrain& terrain);
    /// Until there is something to do.
    void wait(Renderer& renderer, std::unique_lock<std::mutex>& lock);
    /// Whether a picture that is being drawn there is still what is asked for.
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
    glm::uvec2 film_size_px_{0}; ///< of the last picture, if one can follow it; the thread's own
    bool is_job_cancelled_ = false;
    bool is_closing_ = false;
    std::vector<PictureNews> news_;
    std::shared_ptr<const LoadedFile> scene_;      ///< that the renderer holds; the thread's own
    std::unique_ptr<app::WorldAnimator> animator_; ///< of `scene_`; the thread's own
    std::optional<Terrain> terrain_;               ///< in place of the scene's; the thread's own
    bool is_compiling_ = false;                    ///< its shader; the thread's own
    std::thread thread_;
};

/// What was seen in the view while it was recorded: not pictures, but from where, when and how, so that a
/// film of it is drawn as finely as any, however slow the view was.
class Take {
public:
    struct Sample {
        double at_s = 0.0; ///< since it began
        Camera camera;
        double time_s = 0.0; ///< of the animation
        Index animation = 0;
        std::shared_ptr<const app::ChosenStyle> style;
    };

    /// In the order of time.
    void add(Sample sample) { samples_.push_back(std::move(sample)); }

    [[nodiscard]] bool empty() const { return samples_.empty(); }

    [[nodiscard]] double length_s() const { return samples_.empty() ? 0.0 : samples_.back().at_s; }

    /// Between two samples the camera goes straight, and so does the animation where it ran on; all else
    /// holds until the later one. To be called where there are samples.
    [[nodiscard]] Sample at(double seconds) const;

private:
    std::vector<Sample> samples_;
};

/// The first of "fox-001.png", "fox-002.png", ... in the working directory that is not there.
[[nodiscard]] std::string free_name(const std::string& scene, const std::string& extension);

/// Draws the view once more, as estampe render would, and writes it as PNG.
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

/// Draws a take as a film, a frame a step.
class FilmJob : public PictureJob {
public:
    /// A world is animated from its beginning again; `end_s` is when the walker reached the end of the world.
    FilmJob(Take take, std::shared_ptr<const LoadedFile> file, std::optional<double> end_s,
            RenderSettings settings, std::string path);

    bool step(Renderer& renderer, app::WorldAnimator& animator,
              const std::function<void(PictureNews)>& tell) override;

private:
    void begin(const app::WorldAnimator& seen);

    Take take_;
    std::shared_ptr<const LoadedFile> file_;
    std::optional<double> end_s_;
    std::unique_ptr<app::WorldAnimator> animator_; ///< since the first step
    RenderSettings settings_;
    std::string path_;
    uint32_t next_ = 0;
    uint32_t count_;
    std::optional<FilmWriter> writer_;
};

} // namespace estampe::viewer
