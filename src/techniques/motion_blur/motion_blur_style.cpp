// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/motion_blur_style.hpp"

#include "style/parameter.hpp"

namespace estampe::motion_blur {

const style::Table<MotionBlurStyle>& motion_blur_table()
{
    static const auto table =
        style::Table<MotionBlurStyle>("motion_blur", "What moves while the shutter is open")
            .choice("mode", &MotionBlurStyle::mode,
                    {{"none", Mode::none},
                     {"tiles", Mode::tiles},
                     {"own", Mode::own},
                     {"stretched", Mode::stretched},
                     {"velocity", Mode::velocity}},
                    "None; spread over what it passes (tiles); blurred within its outline alone, from "
                    "velocity to velocity (own), or within the shape that it is stretched to along its way "
                    "(stretched); or velocities as colours, red to the right and green upwards")
            .number("shutter_deg", &MotionBlurStyle::shutter_deg, {0.0F, 360.0F}, "deg",
                    "How much of the time from one frame to the next the shutter is open: 360 is all")
            .number("frames_per_s", &MotionBlurStyle::frames_per_s, {1.0F, 1000.0F}, "/s",
                    "Frames a second of a still; a film has its own")
            .number("largest_mm", &MotionBlurStyle::largest_mm, {0.1F, 60.0F}, "mm",
                    "Longest way on the page that is blurred or smeared over")
            .toggle("lines", &MotionBlurStyle::lines, "Draw speed lines behind what is fast")
            .number("lines_length", &MotionBlurStyle::lines_length, {0.1F, 20.0F}, "",
                    "Length of speed lines, as a share of the way that is gone while the shutter is open; 30 "
                    "mm at most")
            .number("lines_spacing_mm", &MotionBlurStyle::lines_spacing_mm, {0.5F, 50.0F}, "mm",
                    "From one speed line to the next, about")
            .number("lines_width_mm", &MotionBlurStyle::lines_width_mm, {0.05F, 5.0F}, "mm",
                    "Width of a speed line where it begins")
            .number("lines_from_mm", &MotionBlurStyle::lines_from_mm, {0.0F, 60.0F}, "mm",
                    "What goes less far than this while the shutter is open has no speed lines")
            .color("lines_ink", &MotionBlurStyle::lines_ink, "Ink of the speed lines")
            .toggle("smear", &MotionBlurStyle::smear,
                    "Draw strokes of a dry brush from the edge that what moves draws after it")
            .number("smear_length", &MotionBlurStyle::smear_length, {0.1F, 20.0F}, "",
                    "Length of the longest smear strokes, as a share of the way that is gone while the "
                    "shutter is open, of which largest_mm is the most")
            .number("smear_spacing_mm", &MotionBlurStyle::smear_spacing_mm, {0.2F, 50.0F}, "mm",
                    "From one smear stroke to the next, about, across their way")
            .number("smear_width_mm", &MotionBlurStyle::smear_width_mm, {0.05F, 10.0F}, "mm",
                    "Width of the broadest smear strokes where they begin")
            .number("smear_from_mm", &MotionBlurStyle::smear_from_mm, {0.0F, 60.0F}, "mm",
                    "What goes less far than this while the shutter is open has no smear strokes")
            .color("smear_ink", &MotionBlurStyle::smear_ink, "Ink of the smear strokes")
            .integer("seed", &MotionBlurStyle::seed, {0, 1000000}, "", "Another number, another hand");
    return table;
}

} // namespace estampe::motion_blur
