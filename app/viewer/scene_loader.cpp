// SPDX-License-Identifier: MIT
#include "viewer/scene_loader.hpp"

#include <algorithm>
#include <utility>

#include "core/failure.hpp"
#include "core/long_jobs.hpp"
#include "drawing.hpp"
#include "worlds.hpp"

namespace estampe::viewer {
namespace {

/// Adds the animation "all", which plays all animations together, if the scene's animations move different
/// things.
void offer_all_animations(Scene& scene)
{
    if (!app::add_all_animations(scene)) {
        scene.animations.pop_back();
        scene.warnings.pop_back();
    }
}

std::shared_ptr<const LoadedFile> load_file(const app::DrawOptions& draw)
{
    auto file = std::make_shared<LoadedFile>();
    file->draw = draw;
    file->scene = load_scene_of(draw);
    offer_all_animations(file->scene);
    file->animation = app::choose_animation(draw, file->scene);
    file->home = app::choose_camera(draw, file->scene, file->animation);
    file->bounds = scene_bounds(file->scene, pose_scene(file->scene, draw.time_s, file->animation));
    if (file->scene.terrain) {
        file->ground_m = file->scene.terrain->sample(0.0, 0.0, draw.time_s).height_m;
    }
    if (const std::unique_ptr<worlds::World> world = app::make_world(draw)) {
        file->visit = world->visit(file->scene);
    }
    if (file->scene.terrain && file->bounds.empty()) {
        constexpr glm::dvec3 near_m(20.0, 5.0, 20.0);
        file->bounds.extend(file->home.eye - near_m);
        file->bounds.extend(file->home.eye + near_m);
    }
    return file;
}

} // namespace

SceneLoader::~SceneLoader()
{
    for (Reading& reading : readings_) {
        reading.thread.join();
    }
}

void SceneLoader::sweep()
{
    readings_.remove_if([](Reading& reading) {
        if (*reading.is_done) {
            reading.thread.join();
            return true;
        }
        return false;
    });
}

void SceneLoader::load(app::DrawOptions draw)
{
    sweep();
    uint64_t number = 0;
    {
        const std::lock_guard lock(guard_);
        number = ++wanted_;
        is_loading_ = true;
        path_ = draw.scene;
        share_.reset();
        result_.reset();
    }
    auto is_done = std::make_shared<std::atomic<bool>>(false);
    readings_.push_back({std::thread([this, draw = std::move(draw), number, is_done] {
                             read(draw, number);
                             *is_done = true;
                         }),
                         is_done});
}

void SceneLoader::read(const app::DrawOptions& draw, uint64_t number)
{
    Result result;
    const ProgressWatch watch([&](double share) { return heed(number, share); });
    try {
        result = load_file(draw);
    } catch (const std::exception&) {
        result = message_of_caught();
    }
    {
        const std::lock_guard lock(guard_);
        if (number != wanted_) {
            return;
        }
        result_ = std::move(result);
        is_loading_ = false;
    }
    wake_();
}

/// Stores the progress of loading a scene. Returns whether loading should continue.
bool SceneLoader::heed(uint64_t number, double share)
{
    {
        const std::lock_guard lock(guard_);
        if (number != wanted_) {
            return false;
        }
        share_ = share;
    }
    wake_();
    return true;
}

std::optional<double> SceneLoader::share() const
{
    const std::lock_guard lock(guard_);
    return share_;
}

void SceneLoader::cancel()
{
    const std::lock_guard lock(guard_);
    ++wanted_;
    is_loading_ = false;
    result_.reset();
}

bool SceneLoader::is_loading() const
{
    const std::lock_guard lock(guard_);
    return is_loading_;
}

std::string SceneLoader::path() const
{
    const std::lock_guard lock(guard_);
    return path_;
}

bool SceneLoader::is_busy() const
{
    return std::ranges::any_of(readings_, [](const Reading& reading) { return !*reading.is_done; });
}

std::optional<SceneLoader::Result> SceneLoader::take()
{
    const std::lock_guard lock(guard_);
    return std::exchange(result_, std::nullopt);
}

} // namespace estampe::viewer
