// SPDX-License-Identifier: MIT
// What a transparent background needs besides the picture: how much of each pixel things cover.
#include "frame/steps.hpp"

namespace estampe::frame {

std::optional<gpu::ImageId> add_cover(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      const haze::HazeLayers& layers, const Colors& colors)
{
    const motion_blur::Mode mode = context.style.motion_blur.mode;
    const bool is_blurred =
        context.plan.motion_blur && mode != motion_blur::Mode::none && mode != motion_blur::Mode::velocity;
    const bool has_lens = context.plan.lens && context.style.lens.mode != lens::Mode::circles;
    if (context.style.paper.transparent != paper::Transparency::background || (!has_lens && !is_blurred)) {
        return std::nullopt;
    }
    const paper::CoverLayers copied =
        paper::add_cover(context.graph, {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines},
                         context.sample.size_px);
    const lens::LensLayers focused = add_lens(
        context, surface, {.wash = copied.wash, .hatch = copied.hatch, .lines = copied.lines}, colors);
    if (!is_blurred) {
        return focused.wash;
    }
    return add_motion_blur(context, scene, visibility, surface,
                           {.wash = focused.wash, .hatch = focused.hatch, .lines = focused.lines}, colors)
        .wash;
}

} // namespace estampe::frame
