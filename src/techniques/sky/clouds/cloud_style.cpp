// SPDX-License-Identifier: MIT
#include "techniques/sky/clouds/cloud_style.hpp"

#include "style/parameter.hpp"

namespace estampe::sky {

const style::Table<CloudStyle>& cloud_table()
{
    static const auto table =
        style::Table<CloudStyle>("clouds", "Clouds over a drawn sky")
            .number("coverage", &CloudStyle::coverage, {0.0F, 0.95F}, "",
                    "Share of the sky overhead that heaped clouds cover; 0 draws none")
            .number("base_m", &CloudStyle::base_m, {50.0F, 20000.0F}, "m",
                    "Height of their flat base; none is seen from above it")
            .number("size_m", &CloudStyle::size_m, {50.0F, 20000.0F}, "m", "Width of a usual one")
            .number("heaped", &CloudStyle::heaped, {0.1F, 3.0F}, "", "How high they are piled up")
            .number("flocks", &CloudStyle::flocks, {0.0F, 0.95F}, "",
                    "Share of the sky that flocks of small flat clouds cover")
            .number("flocks_base_m", &CloudStyle::flocks_base_m, {50.0F, 20000.0F}, "m", "Their height")
            .number("flocks_size_m", &CloudStyle::flocks_size_m, {50.0F, 20000.0F}, "m", "Width of a flock")
            .number("streaks", &CloudStyle::streaks, {0.0F, 0.95F}, "",
                    "Share of the sky that white streaks along the wind cover")
            .number("streaks_base_m", &CloudStyle::streaks_base_m, {50.0F, 20000.0F}, "m", "Their height")
            .number("streaks_size_m", &CloudStyle::streaks_size_m, {50.0F, 50000.0F}, "m",
                    "Width of a bundle of them")
            .number("streaks_mm", &CloudStyle::streaks_mm, {0.05F, 10.0F}, "mm",
                    "Width of a streak on the page")
            .number("wind_mps", &CloudStyle::wind_mps, {0.0F, 1000.0F}, "m/s", "How fast all of them drift")
            .number("wind_deg", &CloudStyle::wind_deg, {-360.0F, 360.0F}, "deg",
                    "Bearing they drift to: 0 is +z, 90 +x")
            .number("change_s", &CloudStyle::change_s, {1.0F, 1000000.0F}, "s",
                    "Time in which they become others and again what they were")
            .color("color", &CloudStyle::color, "Colour of what faces the sun")
            .color("shade_color", &CloudStyle::shade_color, "Colour of what does not")
            .integer("tones", &CloudStyle::tones, {1, 3}, "",
                     "Flat tones: light alone, with shade, or with one between")
            .number("shade", &CloudStyle::shade, {0.0F, 1.0F}, "", "How far shade reaches up the clouds")
            .number("outline_mm", &CloudStyle::outline_mm, {0.0F, 10.0F}, "mm",
                    "Width of their outlines on the page, where it is greatest")
            .number("broken", &CloudStyle::broken, {0.0F, 1.0F}, "",
                    "How far outlines thin and break towards the light")
            .number("hatch", &CloudStyle::hatch, {0.0F, 1.0F}, "",
                    "Darkness of the strokes in their shade; 0 leaves it to the wash")
            .number("hatch_mm", &CloudStyle::hatch_mm, {0.02F, 10.0F}, "mm", "Width of those strokes")
            .number("shadow", &CloudStyle::shadow, {0.0F, 1.0F}, "",
                    "How much of the sun their shadows take from the ground; 0: they throw none")
            .number("reach_m", &CloudStyle::reach_m, {1000.0F, 200000.0F}, "m",
                    "Where they have dissolved in the distance")
            .integer("seed", &CloudStyle::seed, {0, 1000000}, "", "Another number, other clouds");
    return table;
}

} // namespace estampe::sky
