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
                    "How the sun's shadows are stored (shadow map). whole: one map; clipmap: several around "
                    "the camera, finer near; faded: one around the camera, none beyond; warped: one, finer "
                    "near, but edges creep; auto: clipmap for vast scenes, else whole.")
            .number("faded_reach_m", &ShadowStyle::faded_reach_m, {0.1F, 1e5F}, "m",
                    "Largest distance from the camera at which the sun's shadows are drawn. Shadows fade out "
                    "towards this distance; more shows shadows farther away. Only used when shadow.sun_map "
                    "is faded.")
            .choice("edge", &ShadowStyle::edge,
                    {{"plain", Edge::plain}, {"strokes", Edge::strokes}, {"waves", Edge::waves}},
                    "How the edges of shadows look. plain: clean; strokes: hatching strokes run past the "
                    "edge; waves: ragged teeth in two fixed directions. strokes looks like waves where "
                    "hatching is not drawn with lines.")
            .number("edge_reach_mm", &ShadowStyle::edge_reach_mm, {0.0F, 20.0F}, "mm",
                    "How far the ragged teeth at a shadow's edge stick out on the page. 0 is a clean edge, "
                    "more is more ragged. Only used when shadow.edge is strokes or waves.")
            .number("edge_spacing_mm", &ShadowStyle::edge_spacing_mm, {0.05F, 20.0F}, "mm",
                    "Shortest distance between two teeth of a shadow's ragged edge: less gives more teeth. "
                    "The longest distance is twice as much. Only used when shadow.edge is waves.")
            .number("edge_variety", &ShadowStyle::edge_variety, {0.0F, 1.0F}, "",
                    "How much the teeth of a shadow's ragged edge differ in length. 0 makes all teeth equal, "
                    "1 makes some hardly visible. Only used when shadow.edge is strokes or waves.")
            .number("edge_slant_deg", &ShadowStyle::edge_slant_deg, {-180.0F, 180.0F}, "deg",
                    "Angle by which the ragged teeth at shadows' edges are turned, seen from above. At 0, "
                    "the first set of teeth lies across the +z axis, at 90 across the +x axis. Only used "
                    "when shadow.edge is waves.")
            .number(
                "sun_radius_deg", &ShadowStyle::sun_radius_deg, {0.0F, 15.0F}, "deg",
                "Half the angle that the sun's disc fills in the sky: more gives softer edges of shadows. "
                "Shadows far from their object get softest. 0 gives hard edges, 0.27 is the real sun.")
            .choice("ground", &ShadowStyle::ground,
                    {{"auto", GroundMethod::automatic},
                     {"sweep", GroundMethod::sweep},
                     {"pyramid", GroundMethod::pyramid},
                     {"march", GroundMethod::march},
                     {"above", GroundMethod::above}},
                    "How shadows of hills and dunes on the terrain are computed. sweep, pyramid: exactly; "
                    "march: one ray of the sun per point, then a blur; above: exactly, then a blur as "
                    "seen from above; auto: sweep without a GPU, else pyramid.")
            .number(
                "ground_blur_m", &ShadowStyle::ground_blur_m, {0.0F, 4.0F}, "m",
                "Width of the blur of the shadows of hills and dunes: 0 gives hard edges, more gives "
                "softer edges, equally soft near and far. Only used when shadow.ground is march or above.")
            .number("lamp_radius_m", &ShadowStyle::lamp_radius_m, {0.0F, 10.0F}, "m",
                    "Radius of lamps (point lights, spotlights) that set no radius of their own. More gives "
                    "softer edges of shadows, 0 gives hard edges.")
            .integer("local_lights", &ShadowStyle::local_lights, {0, 4096}, "",
                     "Largest number of lamps (point lights, spotlights) that throw shadows. The lamps that "
                     "light most of the picture throw shadows first; other lamps shine without shadows.")
            .integer("local_size", &ShadowStyle::local_size, {0, 4096}, "texels",
                     "Largest width of the shadow maps (images of stored shadows) of lamps, in pixels of the "
                     "map. A point light has six maps. More gives sharper shadows. 0 uses a size that suits "
                     "the picture, between 256 and 2048.")
            .number("local_megatexels", &ShadowStyle::local_megatexels, {0.1F, 32.0F}, "million texels",
                    "Memory for the shadow maps (images of stored shadows) of all lamps together. With too "
                    "little, shadows get coarser and the least important lamps lose theirs. Moving objects "
                    "need the same amount of memory again.");
    return table;
}

namespace {

/// Normal of a slanted plane with the given bearing. Slices along slanted planes cut both floors and walls.
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
