// SPDX-License-Identifier: MIT
#pragma once

// How shadows fall and how their edges are drawn, and what the shaders are told of it.

#include <optional>
#include <span>

#include "shaders/light_variant.glsl.h"
#include "style/parameter.hpp"
#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

/// How the edges of shadows are drawn.
enum class Edge : uint8_t { plain, strokes, waves };

/// What holds the sun's shadow.
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

/// What the hatching's first layer is like, where lines are hatched at all.
struct HatchedLines {
    float width_mm = 0.3F;
    float darkness = 0.5F; ///< of the lines where they run, in full shadow
    uint32_t seed = 1;
    glm::vec2 flat_axis{0.0F, 1.0F}; ///< across the strokes, over UVs and on the page
    glm::vec2 wind{0.0F, 1.0F};      ///< horizontal direction x, z
    glm::vec2 ground_wind{1.0F, 0.0F};
    glm::vec3 towards_light{0.0F, 1.0F, 0.0F};
    bool has_directions = false; ///< some strokes follow height, wind, light or slope
};

/// The teeth that `style` asks for, on a page of so many pixels a millimetre.
[[nodiscard]] shared::EdgeLook edge_look(const ShadowStyle& style, const std::optional<HatchedLines>& lines,
                                         float pixels_per_mm);

/// What the light's shader has to do for it, as bits of shaders/light_variant.glsl.h. Whoever fits the sun's
/// map adds those of clipmaps and of perspective.
[[nodiscard]] uint32_t shadow_variant(const ShadowStyle& style, const std::optional<HatchedLines>& lines);

/// What it has to do besides for those lamps and spots.
[[nodiscard]] uint32_t lamps_variant(std::span<const shared::LocalShadow> lamps);

} // namespace estampe::shadow
