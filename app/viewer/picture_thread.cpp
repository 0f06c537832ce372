// SPDX-License-Identifier: MIT
#include "viewer/picture_thread.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/failure.hpp"
#include "core/long_jobs.hpp"
#include "drawing.hpp"
#include "messages.hpp"

namespace estampe::viewer {
namespace {

Camera between(const Camera& a, const Camera& b, double share)
{
    Camera camera = a;
    const bool are_alike =
        a.orthographic_half_height_m.has_value() == b.orthographic_half_height_m.has_value();
    if (!are_alike) {
        return camera;
    }
    camera.eye = glm::mix(a.eye, b.eye, share);
    camera.target = glm::mix(a.target, b.target, share);
    const glm::dvec3 up = glm::mix(a.up, b.up, share);
    camera.up = glm::length(up) > 1e-3 ? glm::normalize(up) : a.up;
    camera.vertical_fov_rad = glm::mix(a.vertical_fov_rad, b.vertical_fov_rad, share);
    camera.shift = glm::mix(a.shift, b.shift, share);
    if (a.orthographic_half_height_m) {
        camera.orthographic_half_height_m =
            glm::mix(*a.orthographic_half_height_m, *b.orthographic_half_height_m, share);
    }
    return camera;
}

} // namespace

Take::Sample Take::at(double seconds) const
{
    const auto later = std::ranges::upper_bound(samples_, seconds, {}, &Sample::at_s);
    if (later == samples_.begin()) {
        return samples_.front();
    }
    const Sample& before = *(later - 1);
    if (later == samples_.end()) {
        return before;
    }
    const double length_s = later->at_s - before.at_s;
    const double share = length_s > 0.0 ? (seconds - before.at_s) / length_s : 0.0;
    Sample sample = before;
    sample.at_s = seconds;
    sample.camera = between(before.camera, later->camera, share);
    if (before.animation == later->animation && later->time_s >= before.time_s) {
        sample.time_s = glm::mix(before.time_s, later->time_s, share);
    }
    return sample;
}

namespace {

constexpr double frames_per_s = 24.0;

} // namespace

std::string free_name(const std::string& scene, const std::string& extension)
{
    const std::string stem = std::filesystem::path(scene).stem().string();
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}-{:03}{}", stem, number, extension);
        std::error_code problem;
        if (!std::filesystem::exists(name, problem)) {
            return name;
        }
    }
}

bool ScreenshotJob::step(Renderer& renderer, app::WorldAnimator& animator,
                         const std::function<void(PictureNews)>& tell)
{
    const Style style = animator.show(renderer, request_.style, request_.settings.time_s, request_.camera);
    const Image image = renderer.render(request_.camera, style, request_.settings);
    save_png(image, path_);
    tell(JobNews{fmt::format("wrote {}, {} x {}", path_, image.width, image.height)});
    return false;
}

FilmJob::FilmJob(Take take, std::shared_ptr<const LoadedFile> file, std::optional<double> end_s,
                 RenderSettings settings, std::string path)
    : take_(std::move(take)), file_(std::move(file)), end_s_(end_s), settings_(settings),
      path_(std::move(path)),
      count_(std::max(1U, static_cast<uint32_t>(std::lround(take_.length_s() * frames_per_s))))
{
}

void FilmJob::begin(const app::WorldAnimator& seen)
{
    writer_.emplace(path_, settings_.width, settings_.height, frames_per_s,
                    std::filesystem::path(path_).extension() == ".webm");
    animator_ = std::make_unique<app::WorldAnimator>(file_->draw, file_->scene, worlds::Occasion::walk);
    if (end_s_) {
        animator_->end_at(*end_s_);
    }
    if (seen.has_left_ground()) {
        animator_->leave_ground();
    }
}

bool FilmJob::step(Renderer& renderer, app::WorldAnimator& animator,
                   const std::function<void(PictureNews)>& tell)
{
    if (!writer_) {
        begin(animator);
    }
    const Take::Sample sample = take_.at(next_ / frames_per_s);
    settings_.time_s = sample.time_s;
    settings_.animation = sample.animation;
    settings_.continuity = next_ == 0 ? Continuity::starts : Continuity::follows;
    const app::Clock::time_point start = app::Clock::now();
    const Style style = animator_->show(renderer, *sample.style, settings_.time_s, sample.camera);
    Image image = renderer.render(sample.camera, style, settings_);
    const double drawn_s = app::seconds_since(start);
    writer_->add(image);
    ++next_;
    tell(JobNews{fmt::format("Drawing frame {} of {}", next_, count_), static_cast<double>(next_) / count_,
                 false});
    tell(Picture{.image = std::move(image), .continuity = settings_.continuity, .seconds = drawn_s});
    if (next_ < count_) {
        return true;
    }
    writer_->finish();
    tell(JobNews{fmt::format("wrote {}, {} frames", path_, count_)});
    return false;
}

PictureThread::PictureThread(RendererOptions options, std::function<void()> wake)
    : options_(std::move(options)), wake_(std::move(wake)), thread_([this] { work(); })
{
}

PictureThread::~PictureThread()
{
    {
        const std::lock_guard lock(guard_);
        is_closing_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void PictureThread::set_scene(std::shared_ptr<const LoadedFile> file)
{
    const std::lock_guard lock(guard_);
    next_scene_ = std::move(file);
    next_terrain_.reset();
    requests_ = {}; // The waiting requests belong to the previous scene
    change_ = {};
    changed_.notify_all();
}

void PictureThread::set_terrain(const Terrain& terrain)
{
    const std::lock_guard lock(guard_);
    next_terrain_ = terrain;
    changed_.notify_all();
}

void PictureThread::change(SceneChange change)
{
    const std::lock_guard lock(guard_);
    change_.prints.insert(change_.prints.end(), change.prints.begin(), change.prints.end());
    change_.end_s = change.end_s ? change.end_s : change_.end_s;
}

void PictureThread::draw(size_t slot, std::optional<PictureRequest> request)
{
    const std::lock_guard lock(guard_);
    requests_.at(slot) = std::move(request);
    changed_.notify_all();
}

void PictureThread::do_job(std::unique_ptr<PictureJob> job)
{
    const std::lock_guard lock(guard_);
    job_ = std::move(job);
    is_job_cancelled_ = false;
    changed_.notify_all();
}

void PictureThread::cancel_job()
{
    const std::lock_guard lock(guard_);
    is_job_cancelled_ = true;
}

std::vector<PictureNews> PictureThread::take_news()
{
    const std::lock_guard lock(guard_);
    return std::exchange(news_, {});
}

void PictureThread::tell(PictureNews news)
{
    {
        const std::lock_guard lock(guard_);
        news_.push_back(std::move(news));
    }
    wake_();
}

void PictureThread::work()
{
    try {
        Renderer renderer(options_);
        tell(DeviceOpened{renderer.device().name, renderer.device().software});
        work_on(renderer);
    } catch (const std::exception&) {
        tell(Failure{Failure::Of::device, message_of_caught()});
    }
}

void PictureThread::work_on(Renderer& renderer)
{
    std::unique_lock lock(guard_);
    while (!is_closing_) {
        if (next_scene_) {
            const auto file = std::exchange(next_scene_, nullptr);
            lock.unlock();
            take_scene(renderer, file);
            lock.lock();
        } else if (next_terrain_) {
            const Terrain terrain = *std::exchange(next_terrain_, std::nullopt);
            lock.unlock();
            take_terrain(renderer, terrain);
            lock.lock();
        } else if (job_) {
            lock.unlock();
            do_step(renderer);
            lock.lock();
        } else if (requests_[0] || requests_[1]) {
            const size_t slot = requests_.at(next_slot_) ? next_slot_ : 1 - next_slot_;
            next_slot_ = 1 - slot;
            const PictureRequest request = *std::exchange(requests_.at(slot), std::nullopt);
            const SceneChange change = std::exchange(change_, {});
            lock.unlock();
            apply(renderer, change);
            draw_picture(renderer, slot, request);
            lock.lock();
        } else {
            wait(renderer, lock);
        }
    }
    job_.reset();
}

void PictureThread::wait(Renderer& renderer, std::unique_lock<std::mutex>& lock)
{
    if (!is_compiling_) {
        changed_.wait(lock);
        return;
    }
    constexpr std::chrono::milliseconds between_looks(20);
    changed_.wait_for(lock, between_looks);
    lock.unlock();
    if (!renderer.is_terrain_compiling()) {
        is_compiling_ = false;
        tell(TerrainTaken{.is_compiled = true});
    }
    lock.lock();
}

void PictureThread::take_scene(Renderer& renderer, const std::shared_ptr<const LoadedFile>& file)
{
    film_size_px_ = glm::uvec2(0);
    try {
        app::set_scene(renderer, file->scene, file->draw);
        animator_ = std::make_unique<app::WorldAnimator>(file->draw, file->scene, worlds::Occasion::walk);
        scene_ = file;
        terrain_.reset();
        is_compiling_ = false;
        tell(SceneTaken{file});
    } catch (const std::exception&) {
        tell(Failure{Failure::Of::scene, message_of_caught()});
        if (scene_) {
            app::set_scene(renderer, scene_->scene, scene_->draw);
        }
        if (terrain_) {
            renderer.set_terrain(*terrain_);
        }
    }
}

void PictureThread::take_terrain(Renderer& renderer, const Terrain& terrain)
{
    try {
        renderer.set_terrain(terrain, true);
        terrain_ = terrain;
        animator_->leave_ground();
        is_compiling_ = renderer.is_terrain_compiling();
        tell(TerrainTaken{});
    } catch (const std::exception&) {
        tell(Failure{Failure::Of::terrain, message_of_caught()});
    }
}

bool PictureThread::is_wanted(size_t slot)
{
    const std::lock_guard lock(guard_);
    return !is_closing_ && !next_scene_ && !requests_.at(slot);
}

void PictureThread::apply(Renderer& renderer, const SceneChange& change)
{
    try {
        if (!change.prints.empty()) {
            renderer.press(change.prints);
        }
        if (change.end_s && animator_) {
            animator_->end_at(*change.end_s);
        }
    } catch (const std::exception&) {
        tell(Failure{Failure::Of::picture, message_of_caught()});
    }
}

void PictureThread::draw_picture(Renderer& renderer, size_t slot, const PictureRequest& request)
{
    // The first sample of a picture is always finished, so that the user sees something even while the scene
    // moves.
    bool is_stopped = false;
    const ProgressWatch watch([&](double share) {
        is_stopped = share > 0.0 && !is_wanted(slot);
        return !is_stopped;
    });
    try {
        const app::Clock::time_point start = app::Clock::now();
        RenderSettings settings = request.settings;
        const glm::uvec2 size_px(settings.width, settings.height);
        const bool is_film = settings.continuity != Continuity::still;
        if (is_film && size_px != film_size_px_) {
            settings.continuity = Continuity::starts;
        }
        film_size_px_ = glm::uvec2(0);
        const Style style = animator_->show(renderer, request.style, settings.time_s, request.camera);
        Picture picture{.slot = slot,
                        .image = renderer.render(request.camera, style, settings),
                        .scale = request.scale,
                        .samples = settings.samples,
                        .view = request.view,
                        .continuity = settings.continuity};
        film_size_px_ = is_film ? size_px : glm::uvec2(0);
        picture.seconds = app::seconds_since(start);
        picture.timings = renderer.timings();
        picture.notes = renderer.notes();
        tell(std::move(picture));
    } catch (const std::exception&) {
        if (!is_stopped) {
            tell(Failure{Failure::Of::picture, message_of_caught()});
        }
    }
}

void PictureThread::do_step(Renderer& renderer)
{
    bool goes_on = false;
    film_size_px_ = glm::uvec2(0);
    try {
        if (std::exchange(is_compiling_, false)) {
            // Calling set_terrain again waits until the terrain's shader is compiled.
            renderer.set_terrain(*terrain_);
            tell(TerrainTaken{.is_compiled = true});
        }
        goes_on = job_->step(renderer, *animator_, [this](PictureNews news) { tell(std::move(news)); });
    } catch (const std::exception&) {
        tell(Failure{Failure::Of::job, message_of_caught()});
    }
    std::unique_lock lock(guard_);
    if (!goes_on || is_job_cancelled_) {
        const bool was_cancelled = goes_on;
        const std::unique_ptr<PictureJob> ended = std::move(job_);
        lock.unlock();
        if (animator_) {
            animator_->forget_pressed();
        }
        if (was_cancelled) {
            tell(JobNews{"cancelled, nothing was written"});
        }
    }
}

} // namespace estampe::viewer
