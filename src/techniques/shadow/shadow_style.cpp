// SPDX-License-Identifier: MIT
#include "techniques/shadow/shadow_style.hpp"

#include <algorithm>

#include <glm/trigonometric.hpp>

#include "style/parameter.hpp"

namespace estampe::shadow {

const style::Table<ShadowStyle>& shadow_table()
{
    static const auto table =
        style::Table<ShadowStyle>("shadow", "Shadow maps, and the shape of the edges of shadows")
            .choice("sun_map", &ShadowStyle::sun_map,
                    {{"auto", SunMapKind::automatic},
                     {"whole", SunMapKind::whole},
                     {"clipmap", SunMapKind::clipmap},
                     {"faded", SunMapKind::faded},
                     {"warped", SunMapKind::warped}},
                    "How the shadow map of the sun is built. whole: one for the scene; clipmap: several "
                    "around the eye, each twice as wide; faded: one around the eye, fading out; warped: one "
                    "in perspective, edges crawl; auto: whole, or clipmap in vast scenes.")
            .number("faded_reach_m", &ShadowStyle::faded_reach_m, {0.1F, 1e5F}, "m",
                    "Distance from the eye within which the sun throws shadows: shadows fade out as they "
                    "near this distance. Only used when shadow.sun_map is faded.")
            .choice("edge", &ShadowStyle::edge,
                    {{"plain", Edge::plain}, {"strokes", Edge::strokes}, {"waves", Edge::waves}},
                    "How the edges of shadows look. plain: clean; strokes: hatching strokes run past the "
                    "edge; waves: ragged teeth in two directions that are fixed in the world. Without "
                    "hatching lines, strokes gives waves.")
            .number("edge_reach_mm", &ShadowStyle::edge_reach_mm, {0.0F, 20.0F}, "mm",
                    "How far the ragged teeth at a shadow's edge reach to either side: 0 is a clean edge, "
                    "more is more ragged. Only used when shadow.edge is strokes or waves.")
            .number("edge_spacing_mm", &ShadowStyle::edge_spacing_mm, {0.05F, 20.0F}, "mm",
                    "Shortest distance from one tooth of a shadow's ragged edge to the next: less gives more "
                    "teeth. The longest distance is twice as much. Only used when shadow.edge is waves.")
            .number("edge_variety", &ShadowStyle::edge_variety, {0.0F, 1.0F}, "",
                    "How much the teeth of a shadow's ragged edge differ in length: 0 makes all equal, 1 "
                    "makes some hardly visible. Only used when shadow.edge is strokes or waves.")
            .number("edge_slant_deg", &ShadowStyle::edge_slant_deg, {-180.0F, 180.0F}, "deg",
                    "Direction at right angles to the first set of teeth of a shadow's ragged edge: 0 is +z, "
                    "90 is +x. Only used when shadow.edge is waves.")
            .number("sun_radius_deg", &ShadowStyle::sun_radius_deg, {0.0F, 15.0F}, "deg",
                    "Half the angle that the sun fills in the sky: more softens the shadows, most where they "
                    "fall far from the object. 0 gives hard edges, 0.27 is the real sun.")
            .number("lamp_radius_m", &ShadowStyle::lamp_radius_m, {0.0F, 10.0F}, "m",
                    "Radius of point and spot lights that do not set their own radius: a larger lamp throws "
                    "softer shadows. 0 gives hard edges.")
            .integer("local_lights", &ShadowStyle::local_lights, {0, 4096}, "",
                     "Largest number of point and spot lights that throw shadows: the lights that light most "
                     "of the picture are chosen first")
            .integer("local_size", &ShadowStyle::local_size, {0, 4096}, "texels",
                     "Largest size of the shadow map of a spot light, and of each of the six maps of a point "
                     "light: more gives sharper shadows. 0 uses a size that suits the picture, between 256 "
                     "and 2048.")
            .number("local_megatexels", &ShadowStyle::local_megatexels, {0.1F, 32.0F}, "million texels",
                    "Memory for the shadow maps of all point and spot lights. If it is full, maps get "
                    "smaller and the least important lights lose their shadows. Moving objects need the same "
                    "amount of memory again.");
    return table;
}

namespace {

/// Normal of a slanted plane; its slices cut both floors and walls.
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

shared::EdgeProfile edge_profile(const ShadowStyle& style, const std::optional<HatchedLines>& lines,
                                 float pixels_per_mm)
{
    shared::EdgeProfile profile{.amplitude_px = style.edge_reach_mm * pixels_per_mm,
                                .width_px = 0.5F * style.edge_spacing_mm * pixels_per_mm,
                                .darkness = 0.5F,
                                .variety = style.edge_variety,
                                .axis_0 = slanted(style.edge_slant_deg),
                                .axis_1 = slanted(style.edge_slant_deg + 97.0F),
                                .axis_2 = slanted(style.edge_slant_deg + 228.0F)};
    if (follows_strokes(style, lines)) {
        profile.width_px = lines->width_mm * pixels_per_mm;
        profile.darkness = lines->darkness;
        profile.seed = lines->seed;
        profile.flat_axis = lines->flat_axis;
        profile.wind = lines->wind;
        profile.ground_wind = lines->ground_wind;
        profile.towards_light = lines->towards_light;
        profile.has_directions = lines->has_directions ? 1U : 0U;
    }
    return profile;
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
