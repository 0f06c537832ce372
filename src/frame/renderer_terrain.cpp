// SPDX-License-Identifier: MIT
// What the renderer does for a terrain: the ground comes along with the eye and with time.
#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>

#include "frame/renderer_impl.hpp"

namespace estampe {
namespace {

/// Where the square lies in which trails are seen: before the eye, about it where that looks straight down.
glm::dvec2 middle_of_trails(const Camera& camera, double extent_m)
{
    constexpr double ahead = 0.35; // of the side
    const glm::dvec3 view = glm::normalize(camera.target - camera.eye);
    const glm::dvec2 level(view.x, view.z);
    return glm::dvec2(camera.eye.x, camera.eye.z) +
           ahead * extent_m * level / std::max(glm::length(level), 0.1);
}

} // namespace

void Renderer::set_terrain(const Terrain& terrain, bool at_once)
{
    if (!impl_->loaded || !impl_->loaded->terrain) {
        throw Error("the scene has no terrain", "", "give it one before set_scene");
    }
    const bool is_cut_otherwise = frame::swap_terrain(impl_->device, *impl_->loaded, terrain);
    impl_->note_layout();
    if (is_cut_otherwise) {
        impl_->features.invalidate(features::Event::ground_replaced);
    }
    impl_->loaded->terrain->set_source(at_once ? terrain::HeightSource::compiled_meanwhile
                                               : terrain::HeightSource::compiled);
}

bool Renderer::is_terrain_compiling() const
{
    return impl_->loaded && impl_->loaded->terrain && impl_->loaded->terrain->is_compiling();
}

void Renderer::press(std::span<const TrailStamp> stamps)
{
    if (!impl_->loaded || !impl_->loaded->footprints) {
        throw Error("the scene has no terrain", "", "give it one before set_scene");
    }
    impl_->loaded->footprints->press(stamps);
}

void Renderer::Impl::follow_eye(const Camera& camera)
{
    constexpr double far_m = 4096.0;
    const glm::dvec3 away = camera.eye - loaded->layout.anchor;
    if (!loaded->terrain || std::max(std::abs(away.x), std::abs(away.z)) <= far_m) {
        return;
    }
    const glm::dvec3 nearest = 64.0 * glm::round(camera.eye / 64.0);
    loaded->layout.anchor.x = nearest.x;
    loaded->layout.anchor.z = nearest.z;
    loaded->pose.reset();
    features.invalidate(features::Event::anchor_moved);
}

void Renderer::Impl::update_terrain(const Camera& camera, const RenderSettings& settings,
                                    const features::StyleTables& style)
{
    if (!loaded->terrain) {
        return;
    }
    const std::optional<double> before_s = moment_before(settings, style);
    const glm::dvec3 view = camera.target - camera.eye;
    const bool has_moved = loaded->terrain->prepare(
        device, {.eye = {.eye_m = {camera.eye.x, camera.eye.z}, .ahead = {view.x, view.z}},
                 .anchor_m = loaded->layout.anchor,
                 .time_s = settings.time_s,
                 .before_s = before_s ? std::optional(settings.time_s - *before_s) : std::nullopt});
    while (loaded->terrain->is_behind()) {
        gpu::Graph graph;
        loaded->terrain->add_catching_up(graph);
        executor.run(graph);
    }
    loaded->footprints->prepare(device, {.time_s = settings.time_s,
                                         .centre_m = middle_of_trails(camera, loaded->footprints->extent_m()),
                                         .follows = settings.continuity == Continuity::follows});
    while (loaded->footprints->is_behind()) {
        gpu::Graph graph;
        loaded->footprints->add_catching_up(graph);
        executor.run(graph);
    }
    // What poses the rest writes over all.
    loaded->terrain_moved = loaded->terrain_moved || has_moved || loaded->pose_moved;
}

} // namespace estampe
