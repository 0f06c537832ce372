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

inline const style::Table<WashStyle>& wash_table()
{
    static const auto table =
        style::Table<WashStyle>("wash", "Flat colour by material, cooler in shadow")
            .number("strength", &WashStyle::strength, {0.0F, 1.0F}, "",
                    "0 leaves the paper bare, 1 is full colour")
            .number("neutral", &WashStyle::neutral, {0.0F, 1.0F}, "",
                    "Share of the strength that greys are painted with")
            .number("saturation", &WashStyle::saturation, {0.0F, 1.0F}, "",
                    "0 paints greys alone, 1 the materials' colours")
            .number("detail", &WashStyle::detail, {0.0F, 1.0F}, "",
                    "0 is one flat colour a material, 1 its whole texture")
            .number("least", &WashStyle::least, {0.0F, 1.0F}, "",
                    "Brightness, as a share of white, that dark colours are lifted towards: strokes tell how "
                    "dark a thing is")
            .color("shadow_tint", &WashStyle::shadow_tint, "Laid over the colour in shadow")
            .number("shadow_from", &WashStyle::shadow_from, {0.0F, 1.0F}, "",
                    "Darkness at which shadow begins")
            .number("softness", &WashStyle::softness, {0.001F, 0.5F}, "",
                    "Half the width of that step, in darkness")
            .number("light_tint", &WashStyle::light_tint, {0.0F, 1.0F}, "",
                    "How far coloured light colours what it falls on")
            .number("air", &WashStyle::air, {0.0F, 1.0F}, "", "Share of the air's colour in the far distance")
            .color("air_color", &WashStyle::air_color, "Colour of the air")
            .number("air_distance_m", &WashStyle::air_distance_m, {0.001F, 1e6F}, "m",
                    "Distance by which half of the air's colour is reached")
            .by_surface_but({});
    return table;
}

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
/// Writes  rgba16f: what the paint lets through (1: bare paper); alpha 1 where there is a surface
/// Cost    one full-screen dispatch for each look
[[nodiscard]] gpu::ImageId add_wash(gpu::Graph& graph, const WashInputs& in,
                                    const std::vector<LookWash>& looks);

} // namespace estampe::wash
