// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"

namespace estampe::wash {

struct WashStyle {
    float strength = 0.8F;
    float neutral = 0.4F;
    float saturation = 1.0F;
    float detail = 0.35F;
    float least = 0.16F;
    glm::vec3 shadow_tint = style::srgb(0xbac7c3);
    float shadow_from = 0.40F;
    float softness = 0.03F;
    float light_tint = 0.0F;
    float air = 0.0F;
    glm::vec3 air_color = style::srgb(0xf0dca2);
    float air_distance_m = 120.0F;
};

[[nodiscard]] const style::Table<WashStyle>& wash_table();

struct WashInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId color;
    gpu::ImageId light;
    gpu::BufferId draws;
    gpu::BufferId materials;
    gpu::ImageId screen; ///< colour and cover of what is looked through; one texel for none
    bool has_screen = false;
    gpu::ImageId background;    ///< the wash where nothing is
    bool has_background = true; ///< else it is bare paper
    bool keeps_cover = false;   ///< alpha is how much of the pixel things hide: bare ground hides nothing
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> look_of_draw; ///< where surfaces differ: r32ui texels
};

/// How the surfaces of one look are painted.
struct LookWash {
    WashStyle style;
    shared::ToneConstants tone;
};

/// Paints flat colours.
///
/// Writes  rgba16f: what the paint lets through (1: bare paper); alpha 1 where there is a surface, or where
///         `keeps_cover` is set how much of the pixel things hide, see-through ones too
/// Cost    one full-screen dispatch for each look
[[nodiscard]] gpu::ImageId add_wash(gpu::Graph& graph, const WashInputs& in,
                                    const std::vector<LookWash>& looks);

} // namespace estampe::wash
