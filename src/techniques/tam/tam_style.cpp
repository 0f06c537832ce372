// SPDX-License-Identifier: MIT
#include "techniques/tam/tam_style.hpp"

#include "style/parameter.hpp"

namespace estampe::tam {

const style::Table<TamStyle>& tam_table()
{
    static const auto table =
        style::Table<TamStyle>("tam", "Tonal art map: a set of stroke textures from light to dark, drawn in "
                                      "advance by `estampe tam` or for hatch.strokes")
            .integer("size_px", &TamStyle::size_px, {32, 2048}, "px",
                     "Width and height of each stroke texture of the tonal art map, a power of two. More "
                     "repeats less often on a surface and takes longer to draw.")
            .integer("tones", &TamStyle::tones, {4, 8}, "",
                     "Number of tones in the tonal art map (set of stroke textures). More gives finer steps "
                     "from light to dark.")
            .number("lightest", &TamStyle::lightest, {0.02F, 0.5F}, "",
                    "Share of the paper that ink covers in the lightest tone of the tonal art map: more is "
                    "darker")
            .number(
                "darkest", &TamStyle::darkest, {0.3F, 0.97F}, "",
                "Share of the paper that ink covers in the darkest tone of the tonal art map: more is darker")
            .number("curve", &TamStyle::curve, {0.25F, 4.0F}, "",
                    "Spacing of the tones between the lightest and the darkest tone of the tonal art map. "
                    "Above 1, more of the tones are light; below 1, more of the tones are dark.")
            .choice("tool", &TamStyle::tool,
                    {{"pen", Tool::pen},
                     {"pencil", Tool::pencil},
                     {"charcoal", Tool::charcoal},
                     {"burin", Tool::burin},
                     {"brush", Tool::brush}},
                    "Tool that draws the strokes of the tonal art map. pen: clean; pencil, charcoal: grainy; "
                    "burin: thicker in the middle; brush: hairs separate at the end. The option --brush of "
                    "estampe tam uses a picture instead.")
            .number("width_px", &TamStyle::width_px, {1.0F, 24.0F}, "px",
                    "Width of a stroke of the tonal art map, in pixels of its texture: more gives broader "
                    "strokes. The smaller textures for distant surfaces (mip levels) have strokes of this "
                    "width, too.")
            .number("length_px", &TamStyle::length_px, {8.0F, 1000.0F}, "px",
                    "Length of a stroke of the tonal art map, in pixels of its texture: more gives longer "
                    "strokes. Strokes made for the smaller textures of distant surfaces (mip levels) have "
                    "this length there.")
            .number("length_spread", &TamStyle::length_spread, {0.0F, 0.9F}, "",
                    "How much strokes of the tonal art map differ in length. 0 makes all equally long, 0.5 "
                    "makes lengths from half to one and a half times the average.")
            .number("taper_px", &TamStyle::taper_px, {0.0F, 300.0F}, "px",
                    "Length over which a stroke of the tonal art map thins towards its ends. 0 gives blunt "
                    "ends, more gives pointed ends.")
            .number("tip", &TamStyle::tip, {0.2F, 1.0F}, "",
                    "Width of the ends of a stroke of the tonal art map, as a share of its full width. Less "
                    "is pointed, 1 is blunt.")
            .number("pressure", &TamStyle::pressure, {0.0F, 0.8F}, "",
                    "How much the width varies along a stroke of the tonal art map: 0 is even, more looks "
                    "livelier")
            .number("opacity", &TamStyle::opacity, {0.6F, 1.0F}, "",
                    "Opacity of a single stroke in the tonal art map. Below 1, places where strokes cross "
                    "are darker than single strokes.")
            .number(
                "grain", &TamStyle::grain, {0.0F, 1.0F}, "",
                "Grain of strokes of pencil, charcoal and brush in the tonal art map. More lets more paper "
                "show through the stroke and separates the hairs of the brush. Not used by pen and burin.")
            .number("bow", &TamStyle::bow, {0.0F, 0.1F}, "",
                    "How far a stroke of the tonal art map bends, as a share of its length: 0 is straight, "
                    "more is curved")
            .number("wobble", &TamStyle::wobble, {0.0F, 0.1F}, "",
                    "How far a stroke of the tonal art map wavers, as a share of its length: 0 is smooth, "
                    "more is shaky")
            .number("angle_deg", &TamStyle::angle_deg, {-180.0F, 180.0F}, "deg",
                    "Direction of the first layer of strokes in the tonal art map: 0 is horizontal in the "
                    "textures")
            .number("angle_spread_deg", &TamStyle::angle_spread_deg, {0.0F, 45.0F}, "deg",
                    "How much strokes of one layer of the tonal art map differ in direction. 0 makes all "
                    "parallel, more looks looser.")
            .integer("second_from", &TamStyle::second_from, {1, 9}, "",
                     "First tone of the tonal art map, counted from light to dark, with a second layer of "
                     "strokes. This layer crosses the first layer. Less starts crossing in lighter tones, 9 "
                     "draws no second layer.")
            .number("second_deg", &TamStyle::second_deg, {-180.0F, 180.0F}, "deg",
                    "Angle between the first and second layer of strokes in the tonal art map: 90 crosses "
                    "squarely")
            .integer("third_from", &TamStyle::third_from, {1, 9}, "",
                     "First tone of the tonal art map, counted from light to dark, with a third layer of "
                     "strokes. This layer crosses the other two layers. Less starts crossing in lighter "
                     "tones, 9 draws no third layer.")
            .number("third_deg", &TamStyle::third_deg, {-180.0F, 180.0F}, "deg",
                    "Angle between the first and third layer of strokes in the tonal art map: 90 crosses "
                    "squarely")
            .integer("candidates", &TamStyle::candidates, {1, 1000}, "",
                     "Number of random strokes that are tried before the best is added to the tonal art map. "
                     "More spreads the strokes more evenly and takes longer.")
            .by_surface_but({});
    return table;
}

} // namespace estampe::tam
