// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

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

} // namespace estampe::shadow
