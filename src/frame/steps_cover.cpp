// SPDX-License-Identifier: MIT
// What a transparent background needs besides the picture: how much of each pixel things cover.
#include "frame/steps.hpp"

namespace estampe::frame {

std::optional<gpu::ImageId> add_cover(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                                      const surface::Surface& surface, const haze::HazeLayers& layers,
                                      const Colors& colors)
{
    const motion_blur::Mode mode = making.style.motion_blur.mode;
    const bool is_blurred =
        making.plan.motion_blur && mode != motion_blur::Mode::none && mode != motion_blur::Mode::velocity;
    const bool has_lens = making.plan.lens && making.style.lens.mode != lens::Mode::circles;
    if (making.style.paper.transparent != paper::Transparency::background || (!has_lens && !is_blurred)) {
        return std::nullopt;
    }
    const paper::CoverLayers copied =
        paper::add_cover(making.graph, {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines},
                         making.sample.size_px);
    const lens::LensLayers focused = add_lens(
        making, surface, {.wash = copied.wash, .hatch = copied.hatch, .lines = copied.lines}, colors);
    if (!is_blurred) {
        return focused.wash;
    }
    return add_motion_blur(making, scene, visibility, surface,
                           {.wash = focused.wash, .hatch = focused.hatch, .lines = focused.lines}, colors)
        .wash;
}

} // namespace estampe::frame
