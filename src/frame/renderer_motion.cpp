// SPDX-License-Identifier: MIT
// What the renderer does for motion alone.
#include "frame/renderer_impl.hpp"

#include <cmath>

#include <estampe/error.hpp>

#include "features/common/view.hpp"
#include "gpu/imports.hpp"
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
    // Before the beginning an animation would be at its end.
    const double half_s = 0.5 * motion_blur::exposure_s(style.motion_blur);
    return settings.time_s + (settings.time_s < half_s ? half_s : -half_s);
}

namespace {

/// Where a camera stood `share` as long ago as it stood at `before`, if it went straight on.
Camera carried_back(const Camera& now, const Camera& before, double share)
{
    Camera back = before;
    back.eye = glm::mix(now.eye, before.eye, share);
    back.target = glm::mix(now.target, before.target, share);
    return share == 1.0 ? before : back;
}

} // namespace

/// To be called when the scene has been posed as it is now.
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
    // Where a camera alone goes both may be nothing.
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

} // namespace estampe
