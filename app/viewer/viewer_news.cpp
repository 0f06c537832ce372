// SPDX-License-Identifier: MIT
// The viewer's handling of news from threads and files: pictures, scenes, shaders, terrains.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include <estampe/error.hpp>

#include "gpu/shader_bindings.hpp"
#include "piped_scene.hpp"
#include "style/schema.hpp"

namespace estampe::viewer {

void Viewer::take_loaded()
{
    const std::optional<SceneLoader::Result> result = loader_->take();
    if (!result) {
        if (loader_->is_loading() && studio_.work) {
            studio_.work->share = loader_->share().value_or(-1.0);
        }
        return;
    }
    studio_.work.reset();
    if (const auto* problem = std::get_if<std::string>(&*result)) {
        take(Failure{Failure::Of::scene, *problem});
        return;
    }
    const auto& file = std::get<std::shared_ptr<const LoadedFile>>(*result);
    pictures_->set_scene(file);
    report("has read " + file->draw.scene);
}

void Viewer::take(const Failure& failure)
{
    report("failure: " + failure.message);
    if (failure.what == Failure::Of::device ||
        (failure.what == Failure::Of::scene && !studio_.file && !command_.draw.scene.empty())) {
        throw Error(failure.message);
    }
    const char* topic = failure.what == Failure::Of::scene     ? "scene"
                        : failure.what == Failure::Of::terrain ? "terrain"
                        : failure.what == Failure::Of::job     ? "job"
                                                               : "picture";
    if (failure.what == Failure::Of::job) {
        studio_.work.reset();
    }
    if (failure.what == Failure::Of::picture) {
        answered_view_ = requested_view_;
    } else {
        asked_ = {}; // The thread has dropped all waiting requests, so the view is requested again
    }
    studio_.say(Message::Kind::problem, topic, failure.message);
}

void Viewer::take(const SceneTaken& taken)
{
    const std::shared_ptr<const LoadedFile> before = studio_.file;
    const bool is_same = studio_.file && studio_.file->draw.scene == taken.file->draw.scene &&
                         studio_.file->draw.load.up == taken.file->draw.load.up &&
                         studio_.file->scene.terrain.has_value() == taken.file->scene.terrain.has_value();
    studio_.file = taken.file;
    studio_.settle("scene");
    ++scene_number_;
    end_s_.reset();
    const Scene& scene = taken.file->scene;
    const std::string name = std::filesystem::path(taken.file->draw.scene).filename().string();
    const bool is_terrain_alone = scene.terrain && scene.meshes.empty();
    const bool is_watched = !is_terrain_alone && !app::is_piped(taken.file->draw.scene);
    scene_watch_.watch(!is_watched ? std::vector<std::filesystem::path>{}
                                   : files_of_scene(taken.file->draw.scene));
    take_terrain_of(*taken.file, is_same);
    if (!is_same) {
        // The ground under the walker is computed only when the user starts to walk, from surfaces that never
        // move.
        auto ground = std::make_shared<std::optional<Ground>>();
        studio_.rig.set_scene(taken.file->home, taken.file->bounds,
                              [this, file = taken.file, ground](const glm::dvec3& place) {
                                  if (!*ground) {
                                      ground->emplace(file->scene);
                                  }
                                  return height_under(**ground, place);
                              });
        studio_.time = {.time_s = taken.file->draw.time_s,
                        .is_endless = scene.terrain && scene.animations.empty(),
                        .animation = taken.file->animation};
        take_pointer(false);
        if (taken.file->visit && taken.file->draw.camera.kind == app::CameraChoice::Kind::automatic) {
            set_out();
        }
        studio_.bookmark.reset();
        studio_.attempt("bookmarks", [&] {
            studio_.bookmarks = load_bookmarks(bookmarks_path(taken.file->draw.scene),
                                               taken.file->draw.confine.of(taken.file->draw.scene));
        });
        window_.set_title(name + " - Estampe");
    } else {
        raise_camera(taken.file->ground_m - before->ground_m);
        if (studio_.time.animation >= scene.animations.size()) {
            studio_.time.animation = taken.file->animation;
        }
    }
    studio_.time.length_s =
        scene.animations.empty() ? 0.0 : scene.animations.at(studio_.time.animation).duration_s;
    if (!scene.warnings.empty()) {
        studio_.say(Message::Kind::note, "warnings", scene.warnings.front());
    }
    report("shows " + taken.file->draw.scene);
}

void Viewer::take(Picture& picture)
{
    textures_.at(picture.slot)->set(picture.image.width, picture.image.height, picture.image.rgba);
    answered_view_.at(picture.slot) = picture.view;
    const bool is_whole =
        picture.scale == 1.0 && picture.samples == studio_.samples && picture.continuity == Continuity::still;
    if (picture.slot == 0) {
        studio_.shown_scale = picture.scale;
        studio_.shown_px = {picture.image.width, picture.image.height};
        studio_.shown_s = picture.seconds;
        studio_.is_refined = is_whole && picture.view == view_;
        studio_.passes = std::move(picture.timings);
        constexpr size_t most_times = 120;
        studio_.frame_ms.push_back(static_cast<float>(1e3 * picture.seconds));
        if (studio_.frame_ms.size() > most_times) {
            studio_.frame_ms.pop_front();
        }
        if (picture.view > 0 && (!is_whole || studio_.resolution.scale() == 1.0)) {
            studio_.resolution.drawn(picture.scale, picture.seconds);
        }
    }
    studio_.settle("picture");
    if (studio_.is_refined && studio_.is_on_processor && !app::is_piped(studio_.file->draw.scene)) {
        warm_up_.begin(studio_.file->draw.scene);
    }
    report(fmt::format("picture {} of view {}: {} x {}, {:.0f} %, {:.0f} ms{}", picture.slot, picture.view,
                       picture.image.width, picture.image.height, 100.0 * picture.scale,
                       1e3 * picture.seconds, is_whole && picture.view == view_ ? ", refined" : ""));
}

void Viewer::take_news()
{
    for (PictureNews& news : pictures_->take_news()) {
        frames_to_paint_ = std::max(frames_to_paint_, 1);
        if (auto* picture = std::get_if<Picture>(&news)) {
            take(*picture);
        } else if (const auto* failure = std::get_if<Failure>(&news)) {
            take(*failure);
        } else if (const auto* taken = std::get_if<SceneTaken>(&news)) {
            take(*taken);
        } else if (const auto* terrain = std::get_if<TerrainTaken>(&news)) {
            take(*terrain);
        } else if (const auto* device = std::get_if<DeviceOpened>(&news)) {
            studio_.device = device->name;
            studio_.is_on_processor = device->is_processor;
        } else if (const auto* job = std::get_if<JobNews>(&news)) {
            if (job->is_done) {
                studio_.work.reset();
                asked_ = {}; // Forgets the requested view, so that it is requested again
                studio_.say(Message::Kind::note, "job", job->text);
                report(job->text);
            } else {
                studio_.work = Work{job->text, job->share};
            }
        }
    }
}

void Viewer::look_at_files()
{
    constexpr double between_looks_s = 0.1;
    if (app::seconds_since(looked_at_files_) < between_looks_s) {
        return;
    }
    looked_at_files_ = app::Clock::now();
    if (studio_.edited.name() != watched_style_) {
        watched_style_ = studio_.edited.name();
        std::vector<std::filesystem::path> files;
        for (const std::string& part : style::parts_of(watched_style_)) {
            if (part.ends_with(".toml")) {
                files.emplace_back(part);
            }
        }
        style_watch_.watch(files);
    }
    if (!style_watch_.changed().empty()) {
        report("style changed: " + watched_style_);
        studio_.attempt("style", [this] {
            // If the viewer itself saved the style file, the file's style is already loaded.
            if (studio_.edited.differs_from_file()) {
                studio_.edited.load(watched_style_);
            }
        });
    }
    if (!scene_watch_.changed().empty() && studio_.file) {
        report("scene changed");
        read_scene_again();
    }
    if (studio_.terrain) {
        look_at_terrain();
    }
}

void Viewer::take_shaders()
{
    if (!shaders_) {
        return;
    }
    for (ShaderNews& news : shaders_->take()) {
        const std::string topic = "shader " + news.name;
        if (news.problem.empty()) {
            gpu::replace_shader(news.name, std::move(news.spirv));
            studio_.settle(topic);
            studio_.settle("picture");
            studio_.edited.changed(); // Marks the style as changed, so that everything is drawn again
            report(topic + " compiled");
        } else {
            studio_.say(Message::Kind::problem, topic, news.problem);
            report(topic + ": " + news.problem);
        }
    }
}

void Viewer::take_terrain_of(const LoadedFile& file, bool is_same)
{
    standing_m_ = file.ground_m;
    if (!file.scene.terrain) {
        studio_.terrain.reset();
        terrain_sent_ = 0;
        return;
    }
    const Terrain& terrain = *file.scene.terrain;
    if (!is_same || !studio_.terrain) {
        studio_.terrain.emplace(terrain);
    }
    // The edited terrain differs from the terrain in the file, so the renderer must receive the edited
    // terrain.
    const bool is_shown =
        terrain_toml(terrain.description()) == terrain_toml(studio_.terrain->terrain().description());
    terrain_sent_ = is_shown ? studio_.terrain->revision() : 0;
}

void Viewer::take(const TerrainTaken& taken)
{
    studio_.settle("terrain");
    if (taken.is_compiled) {
        // A still picture is requested in full quality, as estampe render would draw it.
        requested_whole_ = {};
        studio_.is_refined = false;
        report("terrain compiled");
    }
}

std::optional<double> Viewer::height_under(const Ground& models, const glm::dvec3& place) const
{
    const std::optional<double> floor_m = models.height_under(place);
    if (!studio_.terrain) {
        return floor_m;
    }
    const double ground_m = studio_.terrain->terrain().sample(place.x, place.z, studio_.time.time_s).height_m;
    return std::max(floor_m.value_or(ground_m), ground_m);
}

void Viewer::send_terrain()
{
    if (!studio_.file || !studio_.terrain) {
        return;
    }
    if (studio_.terrain->revision() != terrain_sent_) {
        terrain_sent_ = studio_.terrain->revision();
        pictures_->set_terrain(studio_.terrain->terrain());
        if (studio_.file->scene.meshes.empty()) {
            unbury_camera();
        }
    }
    if (!studio_.file->scene.meshes.empty() && !ImGui::IsAnyItemActive()) {
        stand_on_terrain();
    }
}

void Viewer::unbury_camera()
{
    constexpr double least_m = 0.5;
    const glm::dvec3& eye = studio_.rig.camera().eye;
    const double height_m = studio_.terrain->terrain().sample(eye.x, eye.z, studio_.time.time_s).height_m;
    raise_camera(std::max(height_m + least_m - eye.y, 0.0));
}

void Viewer::stand_on_terrain()
{
    constexpr double least_m = 1e-3;
    const Terrain& terrain = studio_.terrain->terrain();
    const double ground_m = terrain.sample(0.0, 0.0, studio_.file->draw.time_s).height_m;
    if (std::abs(ground_m - standing_m_) < least_m) {
        return;
    }
    standing_m_ = ground_m;
    auto file = std::make_shared<LoadedFile>(*studio_.file);
    file->ground_m = ground_m;
    file->scene.terrain = terrain;
    file->scene.nodes[file->scene.roots.front()].transform.translation.y = ground_m;
    pictures_->set_scene(std::move(file));
}

void Viewer::raise_camera(double rise_m)
{
    Camera camera = studio_.rig.camera();
    camera.eye.y += rise_m;
    camera.target.y += rise_m;
    studio_.rig.place(camera);
}

void Viewer::look_at_terrain()
{
    TerrainEdit& terrain = *studio_.terrain;
    if (const auto files = terrain.files(); files != watched_terrain_) {
        watched_terrain_ = files;
        terrain_watch_.watch(files);
    }
    const std::vector<std::filesystem::path> changed = terrain_watch_.changed();
    if (changed.empty()) {
        return;
    }
    report("terrain changed: " + changed.front().string());
    // One more frame is painted, because an error message may have to disappear.
    frames_to_paint_ = std::max(frames_to_paint_, 1);
    studio_.attempt("terrain file", [&] {
        const bool is_text =
            std::ranges::find(changed, std::filesystem::path(terrain.name())) != changed.end();
        // If the viewer itself saved the terrain file, the file's terrain is already loaded.
        if (is_text && terrain.differs_from_file()) {
            terrain.load(terrain.name());
        } else if (changed.size() > (is_text ? 1U : 0U)) {
            terrain.read_textures();
        }
    });
}

} // namespace estampe::viewer
