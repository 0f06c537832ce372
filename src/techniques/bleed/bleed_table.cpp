// SPDX-License-Identifier: MIT
#include "techniques/bleed/bleed.hpp"

#include "style/parameter.hpp"

namespace estampe::bleed {

const style::Table<BleedStyle>& bleed_table()
{
    static const auto table =
        style::Table<BleedStyle>("bleed", "Ink that runs into corners and narrow gaps")
            .number("width_mm", &BleedStyle::width_mm, {0.0F, 3.0F}, "mm",
                    "How far ink runs on the page; between solid black, gaps of up to about three quarters "
                    "of this close; 0 is off")
            .number("contrast", &BleedStyle::contrast, {1.0F, 20.0F}, "",
                    "How hard the edge of the ink that ran is")
            .number("level", &BleedStyle::level, {0.1F, 0.9F}, "",
                    "Share of ink around a spot of paper at which it turns to ink; under 0.5 straight edges "
                    "grow a little");
    return table;
}

} // namespace estampe::bleed
