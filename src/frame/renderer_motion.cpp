// SPDX-License-Identifier: MIT
// What the renderer does for motion alone.
#include "frame/renderer_impl.hpp"

#include "frame/view.hpp"
#include "gpu/imports.hpp"

namespace estampe {

void Renderer::Impl::pose_before(const ScenePose& scene_pose)
{
    update_pose(scene_pose);
    if (!loaded->pose_moved) {
        return;
    }
    gpu::Graph graph;
    pose::MeshBuffers& meshes = loaded->meshes;
    const auto posed =
        pose::add_pose(graph, meshes, loaded->layout, gpu::import_whole(graph, "draws", meshes.draws),
                       gpu::import_whole(graph, "rest vertices", meshes.rest_vertices));
    graph.custom("posed before").touch(posed, gpu::Access::compute_storage_read).keep();
    executor.run(graph);
    loaded->pose_moved = false;
}

/// To be called when the scene has been posed as it is now.
frame::MotionPlan Renderer::Impl::plan_motion(const Camera& camera, const RenderSettings& settings)
{
    const auto clip_from_anchor = [&](const Camera& seen_by) {
        return frame::frame_globals(seen_by, loaded->layout.bounds, loaded->layout.anchor,
                                    {.size_px = {settings.width, settings.height}})
            .clip_from_anchor;
    };
    frame::provide_motion(device, motion_pixels, settings);
    return {.clip_from_anchor = clip_from_anchor(camera),
            .clip_from_anchor_before = clip_from_anchor(settings.motion_since->camera),
            .pose_moved = loaded->pose_moved};
}

} // namespace estampe
