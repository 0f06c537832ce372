// SPDX-License-Identifier: MIT
#include "viewer/picture_thread.hpp"

#include <chrono>
#include <utility>

#include <estampe/error.hpp>

#include "clock.hpp"
#include "core/progress_watch.hpp"
#include "drawing.hpp"

namespace estampe::viewer {

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
    requests_ = {}; // of the scene before
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
    } catch (const std::exception& problem) {
        tell(Failure{Failure::Of::device, problem.what()});
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
    } catch (const std::exception& problem) {
        tell(Failure{Failure::Of::scene, problem.what()});
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
    } catch (const std::exception& problem) {
        tell(Failure{Failure::Of::terrain, problem.what()});
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
    } catch (const std::exception& problem) {
        tell(Failure{Failure::Of::picture, problem.what()});
    }
}

void PictureThread::draw_picture(Renderer& renderer, size_t slot, const PictureRequest& request)
{
    // One that is begun has its first sample: of what moves at least that is seen.
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
    } catch (const std::exception& problem) {
        if (!is_stopped) {
            tell(Failure{Failure::Of::picture, problem.what()});
        }
    }
}

void PictureThread::do_step(Renderer& renderer)
{
    bool goes_on = false;
    film_size_px_ = glm::uvec2(0);
    try {
        if (std::exchange(is_compiling_, false)) {
            renderer.set_terrain(*terrain_); // waits for its shader
            tell(TerrainTaken{.is_compiled = true});
        }
        goes_on = job_->step(renderer, *animator_, [this](PictureNews news) { tell(std::move(news)); });
    } catch (const std::exception& problem) {
        tell(Failure{Failure::Of::job, problem.what()});
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
