// SPDX-License-Identifier: MIT
// Motion in the renderer: nodes that a program places, the earlier moment for motion blur and ink, and the
// terrain, which follows the eye and changes over time.
#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>

#include "features/common/view.hpp"
#include "frame/renderer_impl.hpp"
#include "gpu/resources.hpp"
#include "techniques/motion_blur/motion_blur.hpp"

namespace estampe {

void Renderer::place(std::span<const NodePlace> places, double time_s)
{
    if (!impl_->loaded) {
        throw Error("there is no scene whose nodes could be moved", "", "call set_scene first");
    }
    impl_->posed_scene = {};
    frame::place_nodes(impl_->device, *impl_->loaded, places, time_s);
    impl_->note_layout();
}

gpu::BufferId Renderer::Impl::add_moved(gpu::Graph& graph)
{
    pose::MeshBuffers& meshes = loaded->meshes;
    return pose::add_pose_of_moved(graph, meshes, loaded->layout, *loaded->pose, features.cloth.draws(),
                                   gpu::import_whole(graph, "draws", meshes.draws),
                                   gpu::import_whole(graph, "rest vertices", meshes.rest_vertices));
}

void Renderer::Impl::pose_before(const ScenePose& scene_pose)
{
    update_pose(scene_pose);
    if (!loaded->pose_moved) {
        return;
    }
    gpu::Graph graph;
    const gpu::BufferId vertices = add_moved(graph);
    graph.custom("posed before").touch(vertices, gpu::Access::compute_storage_read).keep();
    executor.run(graph);
    posed();
}

std::optional<double> Renderer::Impl::moment_before(const RenderSettings& settings,
                                                    const features::StyleTables& style) const
{
    if (settings.motion_since) {
        return settings.motion_since->time_s;
    }
    const std::optional<double> of_ink = features.ink.before_s(settings, style.ink);
    if (of_ink || !motion_blur::is_wanted(style.motion_blur)) {
        return of_ink;
    }
    if (settings.exposure_end) {
        return settings.exposure_end->time_s;
    }
    // Before the start of an animation there is no pose, because the animation would loop to its end. The
    // exposure interval of the first picture therefore extends forward in time.
    const double half_s = 0.5 * motion_blur::exposure_s(style.motion_blur);
    return settings.time_s + (settings.time_s < half_s ? half_s : -half_s);
}

namespace {

/// Extrapolates the camera linearly in time. `share` = 0 gives the camera `now`, 1 gives the camera `before`.
Camera carried_back(const Camera& now, const Camera& before, double share)
{
    Camera back = before;
    back.eye = glm::mix(now.eye, before.eye, share);
    back.target = glm::mix(now.target, before.target, share);
    back.shift = glm::mix(now.shift, before.shift, share);
    return share == 1.0 ? before : back;
}

} // namespace

/// Plans motion blur. Call this function after the scene has been posed at the time of the picture.
std::optional<frame::MotionBlurPlan>
Renderer::Impl::plan_motion_blur(const Camera& camera, const frame::PagePlan& page_plan, float line_half_px,
                                 const features::StyleTables& style, const RenderSettings& settings)
{
    const std::optional<double> before_s = moment_before(settings, style);
    if (!motion_blur::is_wanted(style.motion_blur) || !before_s) {
        return std::nullopt;
    }
    const double half_s = settings.exposure_end ? settings.time_s - settings.exposure_end->time_s
                                                : 0.5 * motion_blur::exposure_s(style.motion_blur);
    const double back_s = settings.time_s - *before_s;
    // If only the camera moves, the times `back_s` and `half_s` may both be 0.
    const double share = back_s == half_s ? 1.0 : back_s / half_s;
    if (share == 0.0 || !std::isfinite(share)) {
        return std::nullopt;
    }
    const Camera opened = settings.exposure_end ? settings.exposure_end->camera : camera;
    const shared::MotionBlurConstants constants = motion_blur::constants_of(
        style.motion_blur, static_cast<float>(1.0 / share), page_plan.pixels_per_mm, line_half_px);
    return frame::MotionBlurPlan{
        .motion = motion_between(carried_back(camera, opened, share), camera, settings),
        .constants = constants,
        .smear = motion_blur::smear_constants_of(style.motion_blur, constants.scale, constants.most_px,
                                                 page_plan.pixels_per_mm)};
}

features::MotionPlan Renderer::Impl::motion_between(const Camera& before, const Camera& now,
                                                    const RenderSettings& settings) const
{
    const auto clip_from_anchor = [&](const Camera& seen_by) {
        return features::frame_globals(seen_by, loaded->layout.bounds, loaded->layout.anchor,
                                       {.size_px = {settings.width, settings.height}})
            .clip_from_anchor;
    };
    return {.clip_from_anchor = clip_from_anchor(now),
            .clip_from_anchor_before = clip_from_anchor(before),
            .pose_moved = loaded->pose_moved};
}

features::MotionPlan Renderer::Impl::plan_motion(const Camera& camera, const RenderSettings& settings)
{
    features::ensure_motion(device, buffers.motion_pixels, settings);
    return motion_between(settings.motion_since->camera, camera, settings);
}

namespace {

/// Centre of the square in which trails in the sand are visible: ahead of the eye, or below the eye when the
/// camera looks straight down.
glm::dvec2 middle_of_trails(const Camera& camera, double extent_m)
{
    // Distance of the square's centre from the eye, as a share of the square's side.
    constexpr double ahead = 0.35;
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
    // Posing the scene also overwrites the terrain's vertices on the device.
    loaded->terrain_moved = loaded->terrain_moved || has_moved || loaded->pose_moved;
}

} // namespace estampe
