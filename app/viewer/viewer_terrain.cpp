// SPDX-License-Identifier: MIT
// The ground in hand, on its way to the renderer and from its file.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace estampe::viewer {

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
    // What is in hand is not the file's any more: the renderer is to have it too.
    const bool is_shown =
        terrain_toml(terrain.description()) == terrain_toml(studio_.terrain->terrain().description());
    terrain_sent_ = is_shown ? studio_.terrain->revision() : 0;
}

void Viewer::take(const TerrainTaken& taken)
{
    studio_.settle("terrain");
    if (taken.is_compiled) {
        requested_whole_ = {}; // what stands still is drawn as estampe render does
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
    frames_to_paint_ = std::max(frames_to_paint_, 1); // what was wrong with it may be said no more
    studio_.attempt("terrain file", [&] {
        const bool is_text =
            std::ranges::find(changed, std::filesystem::path(terrain.name())) != changed.end();
        // What was saved from here is in hand already.
        if (is_text && terrain.differs_from_file()) {
            terrain.load(terrain.name());
        } else if (changed.size() > (is_text ? 1U : 0U)) {
            terrain.read_textures();
        }
    });
}

} // namespace estampe::viewer
