// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "shaders/light_variant.glsl.h"
#include "techniques/shadow/local/edge.glsl.h"
#include "techniques/shadow/local/local.glsl.h"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe::shadow {

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
