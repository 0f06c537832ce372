// SPDX-License-Identifier: MIT
#pragma once

// Strokes of a dry brush behind what moves, as animators and comic artists draw it.

#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/motion_blur/motion_blur_style.hpp"
#include "techniques/motion_blur/smear.glsl.h"

namespace estampe::motion_blur {

/// A scene has about that many seeds, shared alike by its draws; and each draw four at least, up to four
/// times that many in all.
inline constexpr uint32_t smear_seed_count = 2048;

/// Places on the triangles (three vertices and a draw) whose numbers are in `of`, spread by area in the pose
/// of `places` over each draw. The same for the same triangles. Cost: linear.
[[nodiscard]] std::vector<shared::SmearSeed> spread_seeds(std::span<const uint32_t> of,
                                                          std::span<const glm::uvec4> triangles,
                                                          std::span<const glm::vec3> places);

/// The same on the device, made when a style first asks for it.
struct SmearSeeds {
    gpu::Buffer places;
    uint32_t count = 0;
    bool is_made = false;
};

[[nodiscard]] SmearSeeds upload_seeds(gpu::Device& device, const std::vector<shared::SmearSeed>& seeds);

/// Of the scene.
struct SmearScene {
    gpu::BufferId frame;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before;
    glm::mat4 clip_from_anchor_before; ///< shifted within a pixel as the frame's
    SmearSeeds* seeds;
};

/// Of the page.
struct SmearPage {
    gpu::ImageId page;        ///< rgba32ui: in its last word the way of half the exposure
    gpu::ImageId owner_depth; ///< r32f: of what a line belongs to
    gpu::ImageId depth;       ///< r32f
    glm::uvec2 size_px{0};
};

/// What all passes share, `size_px`, the seeds and the camera before aside.
[[nodiscard]] shared::SmearConstants smear_constants_of(const MotionBlurStyle& style, float scale,
                                                        float most_px, float pixels_per_mm);

/// Draws smear strokes into `lines`. Where nothing moves, or the scene has nothing to move, they keep their
/// bits.
///
/// Cost    one thread a seed that goes to the edge of its body; one a seed that is compared with all others
///         where it gave a stroke; lists of 64 x 64 pixels; a pass over the page, of 63 strokes a pixel at
///         most
[[nodiscard]] gpu::ImageId add_smear(gpu::Graph& graph, const SmearScene& scene, const SmearPage& page,
                                     gpu::ImageId lines, shared::SmearConstants constants);

} // namespace estampe::motion_blur
