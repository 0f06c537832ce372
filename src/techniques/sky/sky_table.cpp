// SPDX-License-Identifier: MIT
#include "techniques/sky/sky.hpp"

#include "style/parameter.hpp"

namespace estampe::sky {

const style::Table<SkyStyle>& sky_table()
{
    static const auto table =
        style::Table<SkyStyle>("sky", "The background: a wash with long level strokes")
            .choice("mode", &SkyStyle::mode,
                    {{"auto", SkyMode::automatic}, {"drawn", SkyMode::drawn}, {"paper", SkyMode::paper}},
                    "Drawn, bare paper, or (auto) drawn where the scene brings a camera and a sun")
            .color("horizon", &SkyStyle::horizon, "Colour of the wash at the horizon")
            .color("zenith", &SkyStyle::zenith, "Colour of the wash high above")
            .number("darkness", &SkyStyle::darkness, {0.0F, 1.0F}, "", "Darkness of the strokes high above")
            .number("width_mm", &SkyStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page")
            .choice("follow", &SkyStyle::follow,
                    {{"auto", SkyFollow::automatic}, {"sun", SkyFollow::sun}, {"none", SkyFollow::none}},
                    "Whether horizon and zenith are those of a low sun and the colours below those of other "
                    "hours, by the height of the sun: yes, no, or (auto) where sun.by = place")
            .color("noon_horizon", &SkyStyle::noon_horizon, "Horizon under a sun higher than 40 degrees")
            .color("noon_zenith", &SkyStyle::noon_zenith, "Zenith under a sun higher than 40 degrees")
            .color("dusk_horizon", &SkyStyle::dusk_horizon, "Horizon when the sun is 2 degrees under it")
            .color("dusk_zenith", &SkyStyle::dusk_zenith,
                   "Zenith when the sun is 2 degrees under the horizon")
            .color("night_horizon", &SkyStyle::night_horizon,
                   "Horizon when the sun is 10 degrees under it and lower")
            .color("night_zenith", &SkyStyle::night_zenith,
                   "Zenith when the sun is 10 degrees under the horizon and lower")
            .number("night_darkness", &SkyStyle::night_darkness, {0.0F, 1.0F}, "",
                    "Darkness of the strokes high above at night")
            .integer("steps", &SkyStyle::steps, {0, 12}, "",
                     "Flat tones from horizon to zenith, each wiped a little into the next; 0 grades evenly")
            .color("high_band", &SkyStyle::high_band, "Colour of a band that is wiped in from above")
            .number("high_band_deg", &SkyStyle::high_band_deg, {0.0F, 90.0F}, "deg",
                    "Height of the middle of its edge; 90 draws none")
            .color("low_band", &SkyStyle::low_band, "Colour of a band that is wiped in at the horizon")
            .number("low_band_deg", &SkyStyle::low_band_deg, {0.0F, 90.0F}, "deg",
                    "Height of the middle of its edge; 0 draws none")
            .number("disc_deg", &SkyStyle::disc_deg, {0.0F, 45.0F}, "deg",
                    "Width of the sun's disc, and by night of the moon's; 0 draws neither, 0.53 is nature's")
            .color("sun_color", &SkyStyle::sun_color, "Colour of the sun's disc")
            .color("moon_color", &SkyStyle::moon_color, "Colour of the moon's")
            .number("moon_lit", &SkyStyle::moon_lit, {0.0F, 1.0F}, "",
                    "Share of the moon's width that shines");
    return table;
}

} // namespace estampe::sky
