// SPDX-License-Identifier: MIT
#include "techniques/motion/motion.hpp"

#include "shaders/motion_comp.hpp"

namespace estampe::motion {

gpu::ImageId add_motion(gpu::Graph& graph, const MotionInputs& in)
{
    auto pass = graph.compute("motion", shaders::motion_comp);
    pass.uniform(in.frame)
        .sample(in.visibility, gpu::Format::rg32ui)
        .sample(in.triangles)
        .sample(in.posed_vertices);
    pass.sample(in.posed_vertices_before);
    const gpu::ImageId motion = pass.write(graph.image(
        "motion", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba32f}));
    pass.push(shared::MotionConstants{.clip_from_anchor = in.clip_from_anchor,
                                      .clip_from_anchor_before = in.clip_from_anchor_before})
        .dispatch_over_page(in.size_px.x, in.size_px.y);
    return motion;
}

} // namespace estampe::motion
