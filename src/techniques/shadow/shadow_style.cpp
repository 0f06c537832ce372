// SPDX-License-Identifier: MIT
#include "techniques/shadow/shadow_style.hpp"

#include <algorithm>

#include <glm/trigonometric.hpp>

#include "style/parameter.hpp"

namespace estampe::shadow {

const style::Table<ShadowStyle>& shadow_table()
{
    static const auto table =
        style::Table<ShadowStyle>("shadow", "How shadows fall")
            .choice(
                "sun_map", &ShadowStyle::sun_map,
                {{"auto", SunMapKind::automatic},
                 {"whole", SunMapKind::whole},
                 {"clipmap", SunMapKind::clipmap},
                 {"faded", SunMapKind::faded},
                 {"warped", SunMapKind::warped}},
                "The sun's shadow map: one for the whole scene; maps about the eye, each twice as wide as "
                "the last; one about the eye, whose shadow pales towards its edge; one in perspective, whose "
                "texels grow with distance, but whose edges crawl; or (auto) whole, unless the scene is far "
                "larger than what is near")
            .number("faded_reach_m", &ShadowStyle::faded_reach_m, {0.1F, 1e5F}, "m",
                    "How far a faded map reaches to each side")
            .choice("edge", &ShadowStyle::edge,
                    {{"plain", Edge::plain}, {"strokes", Edge::strokes}, {"waves", Edge::waves}},
                    "Edges of shadows: plain; the hatching's strokes run past them; or teeth of their own, "
                    "along two directions fixed to the world. Without lines to follow, strokes are waves")
            .number("edge_reach_mm", &ShadowStyle::edge_reach_mm, {0.0F, 20.0F}, "mm",
                    "How far the teeth reach to either side of the edge")
            .number("edge_spacing_mm", &ShadowStyle::edge_spacing_mm, {0.05F, 20.0F}, "mm",
                    "Waves: shortest distance between two teeth; the longest is twice that")
            .number("edge_variety", &ShadowStyle::edge_variety, {0.0F, 1.0F}, "",
                    "How much the teeth differ in length")
            .number("edge_slant_deg", &ShadowStyle::edge_slant_deg, {-180.0F, 180.0F}, "deg",
                    "Waves: bearing of the first direction that the teeth are set across; 0 is +z, 90 +x")
            .number("sun_radius_deg", &ShadowStyle::sun_radius_deg, {0.0F, 15.0F}, "deg",
                    "Half the angle that the sun fills: 0 for hard edges, 0.27 as it is; penumbrae widen "
                    "with distance, and teeth with them")
            .number("lamp_radius_m", &ShadowStyle::lamp_radius_m, {0.0F, 10.0F}, "m",
                    "Radius of lamps and spots that do not say their own: 0 for hard edges")
            .integer("local_lights", &ShadowStyle::local_lights, {0, 4096}, "",
                     "How many lamps and spots throw shadows at most; those that light most of the page do")
            .integer("local_size", &ShadowStyle::local_size, {0, 4096}, "texels",
                     "Largest side of a spot's shadow map, and of each of a lamp's six; 0 takes the page's "
                     "longer side for a spot and half of it for a lamp, within 256 and 2048")
            .number("local_megatexels", &ShadowStyle::local_megatexels, {0.1F, 32.0F}, "million texels",
                    "What all these maps hold together, as much again lying behind them where casters move; "
                    "beyond it they are made smaller, and at last left out");
    return table;
}

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
