// SPDX-License-Identifier: MIT
#pragma once

// Style of shadows and of their edges, and the shader data that it determines.

#include <optional>
#include <span>

#include "shaders/light_variant.glsl.h"
#include "style/parameter.hpp"
#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

enum class Edge : uint8_t { plain, strokes, waves };

/// Kind of shadow map for the sun.
enum class SunMapKind : uint8_t { automatic, whole, clipmap, faded, warped };

struct ShadowStyle {
    SunMapKind sun_map = SunMapKind::automatic;
    float faded_reach_m = 60.0F;
    Edge edge = Edge::plain;
    float edge_reach_mm = 1.0F;
    float edge_spacing_mm = 0.7F;
    float edge_variety = 0.5F;
    float edge_slant_deg = 35.0F;
    float sun_radius_deg = 0.0F;
    float lamp_radius_m = 0.0F;
    int local_lights = 32;
    int local_size = 0;
    float local_megatexels = 16.0F;
};

[[nodiscard]] const style::Table<ShadowStyle>& shadow_table();

/// The hatching's first layer, if lines are hatched.
struct HatchedLines {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< darkness of the lines themselves in full shadow
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< across the strokes, in UV space and on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< horizontal direction x, z
    glm::vec2 ground_wind{1.0F, 0.0F};
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    bool has_directions = false; ///< some strokes follow height, wind, light or slope
};

/// The teeth that `style` asks for, on a page of `pixels_per_mm`.
[[nodiscard]] shared::EdgeProfile edge_profile(const ShadowStyle& style,
                                               const std::optional<HatchedLines>& lines, float pixels_per_mm);

/// Variant bits of the lighting shader (shaders/light_variant.glsl.h) that the style needs. The code that
/// fits the sun's map adds the bits for clipmaps and perspective maps.
[[nodiscard]] uint32_t shadow_variant(const ShadowStyle& style, const std::optional<HatchedLines>& lines);

/// Variant bits that these lamps and spots need in addition.
[[nodiscard]] uint32_t lamps_variant(std::span<const shared::LocalShadow> lamps);

} // namespace estampe::shadow
