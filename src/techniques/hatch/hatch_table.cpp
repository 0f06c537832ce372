// SPDX-License-Identifier: MIT
#include "techniques/hatch/hatch.hpp"

#include "style/parameter.hpp"

namespace estampe::hatch {

const style::Table<HatchStyle>& hatch_table()
{
    static const auto table =
        style::Table<HatchStyle>("hatch", "Pen strokes that carry the tone")
            .toggle("drawn", &HatchStyle::drawn, "Whether there are strokes at all")
            .choice("strokes", &HatchStyle::strokes,
                    {{"lines", Strokes::lines}, {"map", Strokes::map}, {"dots", Strokes::dots}},
                    "Lines of exact tone, the strokes of a tonal art map, or the dots of a screentone")
            .number("width_mm", &HatchStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page")
            .integer("layers", &HatchStyle::layers, {1, 3}, "",
                     "Layers of strokes that cross as tones deepen")
            .choice(
                "coordinates", &HatchStyle::coordinates,
                {{"auto", Coordinates::automatic},
                 {"uv", Coordinates::uv},
                 {"solid", Coordinates::solid},
                 {"form", Coordinates::form},
                 {"height", Coordinates::height},
                 {"wind", Coordinates::wind},
                 {"light", Coordinates::light},
                 {"page", Coordinates::page},
                 {"slope", Coordinates::slope}},
                "What strokes follow: UVs, slices through the solid, the form's curvature, level lines, the "
                "wind, the light, the page, the ground's slopes and ripples, or (auto) the latter on the "
                "ground, UVs where they run unbroken, and else the solid")
            .number("slant_deg", &HatchStyle::slant_deg, {-180.0F, 180.0F}, "deg",
                    "Turn of the first layer over UVs and on the page")
            .number("wind_deg", &HatchStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Where the wind blows to, from +z towards +x")
            .text("materials", &HatchStyle::materials,
                  "What the strokes of single materials follow, as in \"Skin=form, Sea=wind\"")
            .number("wobble_mm", &HatchStyle::wobble_mm, {0.0F, 5.0F}, "mm",
                    "How far a stroke strays sideways")
            .number("gap_mm", &HatchStyle::gap_mm, {0.0F, 20.0F}, "mm",
                    "White between the end of a stroke and the next")
            .number("taper_mm", &HatchStyle::taper_mm, {0.0F, 50.0F}, "mm",
                    "Length over which a stroke thins to its end")
            .number("length_mm", &HatchStyle::length_mm, {1.0F, 500.0F}, "mm",
                    "Length of the shortest strokes")
            .number("pressure", &HatchStyle::pressure, {0.0F, 1.0F}, "",
                    "How much the width varies along a stroke")
            .number("growth", &HatchStyle::growth, {0.0F, 1.0F}, "",
                    "How a stroke begins as tone deepens: 0 as a hairline, 1 short and of full width")
            .number("overrun_mm", &HatchStyle::overrun_mm, {0.0F, 5.0F}, "mm",
                    "How far strokes run over silhouettes onto the paper")
            .number("fade", &HatchStyle::fade, {0.0F, 1.0F}, "",
                    "Share of the darkness left in the far distance")
            .number("fade_distance_m", &HatchStyle::fade_distance_m, {0.001F, 1e6F}, "m",
                    "Distance by which half of the fading has happened")
            .number("black_above", &HatchStyle::black_above, {0.1F, 2.0F}, "",
                    "Darkness from which the paper is covered whole; above 1 never")
            .file("map", &HatchStyle::map,
                  "A .tam file, or a folder of PNG or DDS files; without one the map is drawn as [tam] says")
            .choice("map_tone", &HatchStyle::map_tone,
                    {{"order", MapTone::order}, {"blend", MapTone::blend}, {"step", MapTone::step}},
                    "How tones of a map come together: stroke by stroke, blended, or in hard steps")
            .number("map_contrast", &HatchStyle::map_contrast, {1.0F, 100.0F}, "",
                    "Contrast of a map about its middle; 1 leaves its greys")
            .number("map_texel_mm", &HatchStyle::map_texel_mm, {0.01F, 5.0F}, "mm",
                    "Size of a texel of the map on the page")
            .number("dots_mm", &HatchStyle::dots_mm, {0.1F, 20.0F}, "mm", "From dot to dot of a screentone")
            .number("dots_deg", &HatchStyle::dots_deg, {-90.0F, 90.0F}, "deg",
                    "Turn of a screentone on the page")
            .integer("dots_tones", &HatchStyle::dots_tones, {0, 32}, "",
                     "Tones of which screentones are cut, black among them; 0 for as many as there are")
            .integer("seed", &HatchStyle::seed, {0, 1000000}, "", "Another number, another hand")
            .by_surface_but({"materials"});
    return table;
}

} // namespace estampe::hatch
