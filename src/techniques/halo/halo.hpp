// SPDX-License-Identifier: MIT
#pragma once

// Halos: strokes of sky and ground thin out around things that stand in front of them. This technique
// measures the distance on the page to the nearest thing.

#include <cstdint>

#include <glm/vec2.hpp>

#include "gpu/graph/graph.hpp"

namespace estampe::halo {

struct HaloInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId draw;   ///< r32ui: see shaders/surface_images.glsl
    gpu::ImageId normal; ///< rg32ui: normals bent by normal maps, and smooth normals
    /// Draw calls of the ground and the terrain; UINT32_MAX where there is none.
    glm::uvec2 ground_draws{UINT32_MAX};
    float reach_px = 0.0F; ///< width of the widest halo
    float pixels_per_mm = 0.0F;
    glm::uvec2 size_px{0};
};

/// Measures distances on the page to the nearest pixel that shows a thing. All surfaces are things except the
/// ground, planes that are level, such as floors and table tops, and edges between these that are at most 1.2
/// mm wide on the page.
///
/// Writes  r16f, one texel per 4 x 4 pixels of the page: distance from the texel's middle to the nearest
/// texel with a thing
///         in pixels, 0 in texels with a thing; exact up to `reach_px`, larger beyond
/// Cost    one read of two images of the page, and two dispatches over a sixteenth of the page
[[nodiscard]] gpu::ImageId add_distances(gpu::Graph& graph, const HaloInputs& in);

/// Distance in pixels at which a thing changes the strokes of a pixel, for tiles of a page.
[[nodiscard]] uint32_t reach_px(float halo_mm, float pixels_per_mm);

} // namespace estampe::halo
