// SPDX-License-Identifier: MIT
#pragma once

// Style of shadows and of their edges, and the shader data that follows from it.

#include <optional>
#include <span>

#include "shaders/light_variant.glsl.h"
#include "style/parameter.hpp"
#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

enum class Edge : uint8_t { plain, strokes, waves };

/// Kind of the sun's shadow map: a single map of everything, a clipmap, a single level that fades, or a
/// perspective map.
enum class SunMapKind : uint8_t { automatic, whole, clipmap, faded, warped };

/// How the shadow of the terrain on itself is computed; see HeightMethod.
enum class GroundMethod : uint8_t { automatic, sweep, pyramid, march, above };

struct ShadowStyle {
    SunMapKind sun_map = SunMapKind::automatic;
    float faded_reach_m = 60.0F;
    Edge edge = Edge::plain;
    float edge_reach_mm = 1.0F;
    float edge_spacing_mm = 0.7F;
    float edge_variety = 0.5F;
    float edge_slant_deg = 35.0F;
    float sun_radius_deg = 0.0F;
    GroundMethod ground = GroundMethod::automatic;
    float ground_blur_m = 0.5F;
    float lamp_radius_m = 0.0F;
    int local_lights = 32;
    int local_size = 0;
    float local_megatexels = 16.0F;
};

[[nodiscard]] const style::Table<ShadowStyle>& shadow_table();

/// Properties of the hatching's first layer, if lines are hatched. Shadow edges follow the first layer.
struct HatchedLines {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< darkness of the hatching lines themselves in full shadow
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< direction across the strokes, in UV space and on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< horizontal direction of the wind (x, z)
    glm::vec2 ground_wind{1.0F, 0.0F};
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    /// Some strokes follow height, wind, light or slope, not UV coordinates.
    bool has_directions = false;
};

/// Computes the teeth (small strokes) of shadow edges for the style `style`, on a page of `pixels_per_mm`.
[[nodiscard]] shared::EdgeProfile edge_profile(const ShadowStyle& style,
                                               const std::optional<HatchedLines>& lines, float pixels_per_mm);

/// Bits of the lighting shader's `variant` (shaders/light_variant.glsl.h) that the style needs. The code that
/// fits the sun's map adds the bits for clipmaps and perspective maps.
[[nodiscard]] uint32_t shadow_variant(const ShadowStyle& style, const std::optional<HatchedLines>& lines);

/// Bits of the lighting shader's `variant` that the given lamps and spots need in addition.
[[nodiscard]] uint32_t lamps_variant(std::span<const shared::LocalShadow> lamps);

} // namespace estampe::shadow
