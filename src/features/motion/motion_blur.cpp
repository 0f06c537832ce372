// SPDX-License-Identifier: MIT
#include "features/motion/motion_blur.hpp"

namespace estampe::features {
void MotionBlur::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        memory_.forget();
        smear_seeds_ = {};
    }
}

void MotionBlur::prepare(gpu::Device& device, const pose::MeshData& layout,
                         const motion_blur::MotionBlurStyle& style)
{
    if (memory_.lacks_vertices(style)) {
        memory_.set_vertices(device, layout.stroke_coordinates, layout.draw_of_vertex);
    }
    if (style.smear.enabled && !smear_seeds_.is_made) {
        smear_seeds_ = motion_blur::upload_seeds(
            device, motion_blur::spread_seeds(pose::solid_triangles(layout), layout.triangles,
                                              layout.stroke_coordinates));
    }
}

std::optional<motion_blur::VelocityShape> MotionBlur::record(gpu::Graph& graph,
                                                             const motion_blur::VelocityShapeInputs& in,
                                                             const motion_blur::MotionBlurStyle& style)
{
    return motion_blur::add_velocity_shape(graph, memory_, in, style);
}

} // namespace estampe::features
