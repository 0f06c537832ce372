// SPDX-License-Identifier: MIT
#include "techniques/lens/lens_style.hpp"

#include "style/parameter.hpp"

namespace estampe::lens {

const style::Table<LensStyle>& lens_table()
{
    static const auto table =
        style::Table<LensStyle>("lens", "A lens that is sharp at one distance: depth of field")
            .choice(
                "mode", &LensStyle::mode,
                {{"none", Mode::none},
                 {"gather", Mode::gather},
                 {"separable", Mode::separable},
                 {"mips", Mode::mips},
                 {"sums", Mode::sums},
                 {"circles", Mode::circles}},
                "None; a near and a far field (gather); a blur across and down the page (separable); smaller "
                "pages looked up (mips), or the sum of several (sums), which are quicker and run over edges; "
                "or the circles of confusion alone, red before the plane in focus and blue behind it")
            .choice("acts_on", &LensStyle::acts_on,
                    {{"picture", ActsOn::picture}, {"wash", ActsOn::wash}, {"strokes", ActsOn::strokes}},
                    "What is out of focus: colour, strokes and lines are blurred together, colour alone, or "
                    "colour is blurred and strokes and lines become fewer, wider and paler")
            .number("focal_mm", &LensStyle::focal_mm, {1.0F, 2000.0F}, "mm",
                    "Focal length; the sensor is as large as the camera's field of view makes it")
            .number("f_number", &LensStyle::f_number, {0.1F, 128.0F}, "",
                    "Focal length by the width of the aperture: the smaller, the less is sharp")
            .number("focus_m", &LensStyle::focus_m, {0.0F, 1e6F}, "m",
                    "Distance of the plane in focus; 0 is the middle of the scene")
            .text("focus_on", &LensStyle::focus_on,
                  "Object whose middle is in focus in its place; * stands for any letters")
            .number("largest_mm", &LensStyle::largest_mm, {0.1F, 60.0F}, "mm",
                    "Widest circle on the page that a point may become")
            .integer("blades", &LensStyle::blades, {0, 12}, "",
                     "Blades of the aperture, whose corners show in points of light; up to 2 it is round")
            .number("blade_turn_deg", &LensStyle::blade_turn_deg, {0.0F, 360.0F}, "deg",
                    "How far the aperture is turned")
            .number(
                "widen", &LensStyle::widen, {0.0F, 4.0F}, "",
                "Of strokes that are out of focus: how much wider, and farther from each other, they are by "
                "a millimetre of blur")
            .number("pale", &LensStyle::pale, {0.0F, 4.0F}, "", "And how much paler");
    return table;
}

} // namespace estampe::lens
