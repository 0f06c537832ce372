// SPDX-License-Identifier: MIT
#include "techniques/screen/screen.hpp"

#include "style/parameter.hpp"

namespace estampe::screen {

const style::Table<ScreenStyle>& screen_table()
{
    static const auto table =
        style::Table<ScreenStyle>("screen", "What is looked through")
            .choice("mode", &ScreenStyle::mode, {{"ink", Mode::ink}, {"sorted", Mode::sorted}},
                    "As screened ink that tints what is behind (ink); or each see-through surface lit and "
                    "painted by itself, over what is behind it (sorted)")
            .integer("layers", &ScreenStyle::layers, {1, most_sorted_layers}, "",
                     "See-through surfaces of a pixel that count, the nearest first, 4 at most in ink; each "
                     "one costs a pass, where the scene has as many, and sorted ones are lit one by one");
    return table;
}

} // namespace estampe::screen
