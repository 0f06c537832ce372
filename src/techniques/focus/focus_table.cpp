// SPDX-License-Identifier: MIT
#include "techniques/focus/focus.hpp"

#include "style/parameter.hpp"

namespace estampe::focus {

const style::Table<FocusStyle>& focus_table()
{
    static const auto table =
        style::Table<FocusStyle>("focus", "Focus lines, from the edge of the picture towards what matters")
            .toggle("drawn", &FocusStyle::drawn, "Whether there are any")
            .number("x", &FocusStyle::x, {-1.0F, 2.0F}, "",
                    "Where they point, as a share of the picture's width from its left")
            .number("y", &FocusStyle::y, {-1.0F, 2.0F}, "", "And of its height from above")
            .number("clear", &FocusStyle::clear, {0.0F, 3.0F}, "",
                    "Size of the oval they leave free, as a share of the picture's")
            .number("ragged", &FocusStyle::ragged, {0.0F, 1.0F}, "", "How much they differ in length")
            .number("width_mm", &FocusStyle::width_mm, {0.05F, 20.0F}, "mm",
                    "Width of a usual one at the edge")
            .number("spacing_mm", &FocusStyle::spacing_mm, {0.2F, 100.0F}, "mm",
                    "From one to the next at the edge, on average")
            .number("bundles", &FocusStyle::bundles, {0.0F, 1.0F}, "",
                    "How much they come in bundles with gaps between")
            .color("ink", &FocusStyle::ink, "Colour of their ink")
            .number("redraws_per_s", &FocusStyle::redraws_per_s, {0.0F, 60.0F}, "",
                    "How often they are drawn anew as time goes by; 0 leaves them as they are")
            .integer("seed", &FocusStyle::seed, {0, 1000000}, "", "Another number, another hand");
    return table;
}

} // namespace estampe::focus
