// SPDX-License-Identifier: MIT
#include "techniques/shadow/local/edge_look.hpp"

#include <algorithm>

#include <glm/trigonometric.hpp>

namespace estampe::shadow {
namespace {

/// A plane's normal that slices floors as well as walls.
glm::vec3 slanted(float bearing_deg)
{
    const float bearing = glm::radians(bearing_deg);
    return {0.86F * glm::sin(bearing), 0.51F, 0.86F * glm::cos(bearing)};
}

bool follows_strokes(const ShadowStyle& style, const std::optional<HatchedLines>& lines)
{
    return style.edge == Edge::strokes && lines;
}

} // namespace

shared::EdgeLook edge_look(const ShadowStyle& style, const std::optional<HatchedLines>& lines,
                           float pixels_per_mm)
{
    shared::EdgeLook look{.amplitude_px = style.edge_reach_mm * pixels_per_mm,
                          .width_px = 0.5F * style.edge_spacing_mm * pixels_per_mm,
                          .darkness = 0.5F,
                          .variety = style.edge_variety,
                          .axis_0 = slanted(style.edge_slant_deg),
                          .axis_1 = slanted(style.edge_slant_deg + 97.0F),
                          .axis_2 = slanted(style.edge_slant_deg + 228.0F)};
    if (follows_strokes(style, lines)) {
        look.width_px = lines->width_mm * pixels_per_mm;
        look.darkness = lines->darkness;
        look.seed = lines->seed;
        look.flat_axis = lines->flat_axis;
        look.wind = lines->wind;
        look.ground_wind = lines->ground_wind;
        look.towards_light = lines->towards_light;
        look.has_directions = lines->has_directions ? 1U : 0U;
    }
    return look;
}

uint32_t shadow_variant(const ShadowStyle& style, const std::optional<HatchedLines>& lines)
{
    const bool has_teeth = style.edge != Edge::plain && style.edge_reach_mm > 0.0F;
    const bool by_strokes = has_teeth && follows_strokes(style, lines);
    return (by_strokes ? shared::light_has_stroke_edges : 0U) |
           (has_teeth && !by_strokes ? shared::light_has_wave_edges : 0U) |
           (style.sun_radius_deg > 0.0F ? shared::light_has_soft_sun : 0U);
}

uint32_t lamps_variant(std::span<const shared::LocalShadow> lamps)
{
    return std::ranges::any_of(lamps, [](const auto& lamp) { return lamp.radius_m > 0.0F; })
               ? shared::light_has_soft_lamps
               : 0U;
}

} // namespace estampe::shadow
