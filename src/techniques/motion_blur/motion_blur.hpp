// SPDX-License-Identifier: MIT
#pragma once

// What moves while the shutter is open is blurred along its way, or drawn with speed lines or smear strokes.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "techniques/motion_blur/motion_blur.glsl.h"
#include "techniques/motion_blur/motion_blur_style.hpp"
#include "techniques/motion_blur/smear.hpp"

namespace estampe::motion_blur {

/// How long the shutter is open, in seconds.
[[nodiscard]] double exposure_s(const MotionBlurStyle& style);

/// Whether the style asks for anything that hangs on motion.
[[nodiscard]] bool is_wanted(const MotionBlurStyle& style);

/// What all passes share; `scale` is from motion on the page to the way in half the exposure, `line_half_px`
/// half the widest line of the scene.
[[nodiscard]] shared::MotionBlurConstants constants_of(const MotionBlurStyle& style, float scale,
                                                       float pixels_per_mm, float line_half_px);

struct MotionBlurInputs {
    gpu::ImageId motion; ///< rgba32f: pixels to the right and down, the depth before, 1 where known
    gpu::ImageId
        own_motion;     ///< what of the page moves where nothing in `motion` does; the same unless stretched
    gpu::ImageId depth; ///< r32f: reversed, 0 where nothing is
    gpu::ImageId wash;  ///< rgba16f
    gpu::ImageId hatch; ///< r16f
    gpu::ImageId lines; ///< rgba8
    gpu::ImageId sky_ink; ///< r16f
    bool has_sky = false; ///< else there is no such ink
    glm::uvec2 size_px{0};
    glm::uvec2 window_min_px{0}; ///< tiles beyond the window are left as they are
    glm::uvec2 window_max_px{~0U};
    std::optional<SmearScene> smear; ///< where the style has it
    bool by_groups = false; ///< the pixels of a tile are looked at by as many threads, as GPUs like it
};

struct MotionBlurLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
    bool holds_sky = true; ///< `hatch` has the sky's ink where nothing is seen
};

/// Draws layers as they are seen while the shutter is open, all together, so that on paper they are the
/// picture blurred; and speed lines and smear strokes over them.
///
/// Writes  the layers in place, or new ones; what stands still, and is not passed by anything, keeps its bits
/// Cost    a pass over the page that packs it, two over its tiles, one of 64 texels a pixel at most over the
///         tiles that anything moves through; speed lines three more, of 16 lines a pixel at most; smear
///         strokes those of add_smear()
[[nodiscard]] MotionBlurLayers add_motion_blur(gpu::Graph& graph, const MotionBlurInputs& in,
                                               const MotionBlurStyle& style,
                                               shared::MotionBlurConstants constants,
                                               const shared::SmearConstants& smear);

} // namespace estampe::motion_blur
