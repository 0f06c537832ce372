// SPDX-License-Identifier: MIT
#include "techniques/paper/paper.hpp"

#include "style/parameter.hpp"

namespace estampe::paper {

const style::Table<PaperStyle>& paper_table()
{
    static const auto table =
        style::Table<PaperStyle>("paper", "The page, and how ink and paint lie on it")
            .number("height_mm", &PaperStyle::height_mm, {10.0F, 5000.0F}, "mm",
                    "Height of the picture on the page: what millimetres of pen width refer to")
            .number("margin_mm", &PaperStyle::margin_mm, {0.0F, 1000.0F}, "mm",
                    "Blank edge around what is drawn, at most a third of the shorter side")
            .number("border_mm", &PaperStyle::border_mm, {0.0F, 5.0F}, "mm",
                    "Width of the line drawn around the picture, at its margin")
            .color("color", &PaperStyle::color, "Colour of the paper")
            .choice("transparent", &PaperStyle::transparent,
                    {{"none", Transparency::none},
                     {"background", Transparency::background},
                     {"paper", Transparency::paper}},
                    "Which paper is left out of the picture, which then has an alpha channel: none, the "
                    "background beyond all things, or all bare paper, which leaves ink and paint alone")
            .number("grain", &PaperStyle::grain, {0.0F, 1.0F}, "", "Relief of the paper")
            .number("granulation", &PaperStyle::granulation, {0.0F, 1.0F}, "",
                    "How far paint settles in the hollows")
            .color("ink", &PaperStyle::ink, "Ink of the strokes")
            .number("ink_break", &PaperStyle::ink_break, {0.0F, 1.0F}, "",
                    "How far ink skips the heights of the paper")
            .number(
                "ink_grain", &PaperStyle::ink_grain, {0.0F, 1.0F}, "",
                "How far strokes and lines catch on the tooth of the paper alone, as graphite and chalk do")
            .number("ink_tint", &PaperStyle::ink_tint, {0.0F, 1.0F}, "",
                    "How far coloured light colours the ink of the strokes")
            .integer("seed", &PaperStyle::seed, {0, 1000000}, "", "Another number, another sheet");
    return table;
}

} // namespace estampe::paper
