// SPDX-License-Identifier: MIT
#include "features/motion/motion_blur.hpp"

#include <vector>

namespace estampe::features {
namespace {

motion_blur::SmearSeeds smear_seeds_of(gpu::Device& device, const pose::MeshData& layout)
{
    std::vector<uint32_t> solid;
    for (const pose::Range& range : {layout.opaque, layout.masked}) {
        for (uint32_t i = range.first; i < range.first + range.count; ++i) {
            if (layout.triangles[i].x < layout.foreign_vertex.value_or(UINT32_MAX)) {
                solid.push_back(i);
            }
        }
    }
    return motion_blur::upload_seeds(
        device, motion_blur::spread_seeds(solid, layout.triangles, layout.stroke_coordinates));
}

} // namespace

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
    if (style.smear && !smear_seeds_.is_made) {
        smear_seeds_ = smear_seeds_of(device, layout);
    }
}

} // namespace estampe::features
