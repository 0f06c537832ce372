// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <estampe/read_scope.hpp>

#include "gpu/graph/graph.hpp"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"

namespace estampe::wash {

/// Value of WashStyle::shade_texture: the texture that the material of a scene's file has for the shade.
inline constexpr const char* shade_of_material = "material";

/// Value of WashStyle::shade_texture: surfaces have no texture for the shade.
inline constexpr const char* no_shade = "none";

/// What decides where a surface with a shade texture changes from light to shade.
enum class ShadeStep : uint8_t { material, wash };

struct WashStyle {
    float strength = 0.8F;
    float neutral = 0.4F;
    float saturation = 1.0F;
    float detail = 0.35F;
    float least = 0.16F;
    glm::vec3 shadow_tint = style::srgb(0xbac7c3);
    float shadow_from = 0.40F;
    float softness = 0.03F;
    float ground_shadow = 0.6F;
    float light_tint = 0.0F;
    float spot = 0.0F;
    glm::vec3 spot_color = style::srgb(0xe05a4f);
    /// `shade_of_material`, `no_shade`, or the path of a picture.
    std::string shade_texture = shade_of_material;
    ReadScope scope; ///< Limits the files that the style may name; no parameter
    ShadeStep shade_step = ShadeStep::material;
    float air = 0.0F; ///< strength of the tint of distant colours; value of the style's key haze.tint
    /// Colour of the air that tints distant surfaces; value of haze.tint_color.
    glm::vec3 air_color = style::srgb(0xf0dca2);
    float air_distance_m = 120.0F; ///< distance over which colours are tinted; value of haze.tint_distance_m
};

[[nodiscard]] const style::Table<WashStyle>& wash_table();

struct WashInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId color;
    gpu::ImageId light;
    gpu::BufferId draws;
    gpu::BufferId materials;
    /// Colour and coverage of transparent surfaces; one texel without transparent surfaces.
    gpu::ImageId screen;
    bool has_screen = false;
    /// rgba16f: linear colour of surfaces in the shade, and in alpha a value as in shaders/shade.glsl.h.
    std::optional<gpu::ImageId> shade;
    gpu::ImageId background;    ///< wash of the background (sky), where no surface is visible
    bool has_background = true; ///< false: the background is bare paper
    bool keeps_cover = false;   ///< the wash stores the coverage by objects in alpha
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> variant_of_draw; ///< style variant of each draw call, r32ui texels; only if
                                                  ///< there are several variants
};

/// How the surfaces of one style variant are painted.
struct WashVariant {
    WashStyle style;
    shared::ToneConstants tone;
};

/// Adds passes that paint flat colours on surfaces.
///
/// Writes  rgba16f: transmittance of the paint (1: bare paper). Alpha is 1 where there is a surface; with
///         `keeps_cover` it is the coverage of objects, transparent ones included
/// Cost    one full-screen dispatch per style variant
[[nodiscard]] gpu::ImageId add_wash(gpu::Graph& graph, const WashInputs& in,
                                    const std::vector<WashVariant>& variants);

} // namespace estampe::wash
