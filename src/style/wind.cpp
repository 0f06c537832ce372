// SPDX-License-Identifier: MIT
#include "style/wind.hpp"

namespace estampe::wind {

const style::Table<WindStyle>& wind_table()
{
    static const auto table =
        style::Table<WindStyle>(
            "wind", "Wind that moves cloth, smoke, clouds and particles, and that strokes can follow")
            .choice(
                "from", &WindStyle::from,
                {{"auto", WindSource::automatic}, {"style", WindSource::style}, {"smoke", WindSource::smoke}},
                "Which wind is used. auto: the wind of the terrain, or style without a terrain; style: "
                "wind.speed_m_per_s and wind.towards_deg; smoke: for cloth, the moving air in smoke boxes, "
                "for everything else the same as style.")
            .number("speed_m_per_s", &WindStyle::speed_m_per_s, {0.0F, 60.0F}, "m/s",
                    "Mean speed of the wind: 0 is still air, 4 a breeze, 15 a storm. Not used when wind.from "
                    "is auto and the scene has a terrain.")
            .number("blown_m", &WindStyle::blown_m, {-1.0F, 1e7F}, "m",
                    "Distance that the wind on cloth has already blown. Films in which wind.speed_m_per_s "
                    "changes set this value in each frame, or gusts would jump. -1 computes the distance as "
                    "speed times time.")
            .number("towards_deg", &WindStyle::towards_deg, {-360.0F, 360.0F}, "deg",
                    "Direction towards which the wind blows, seen from above: 0 is the +z axis, 90 is the +x "
                    "axis. Not used when wind.from is auto and the scene has a terrain.")
            .number("gustiness", &WindStyle::gustiness, {0.0F, 1.0F}, "",
                    "How much the speed of the wind on cloth changes in gusts. 0 is steady, 1 changes "
                    "between calm and twice the speed.")
            .number("gust_m", &WindStyle::gust_m, {0.1F, 1000.0F}, "m",
                    "Approximate distance from one gust of wind to the next: less makes the wind change more "
                    "often")
            .number("turbulence", &WindStyle::turbulence, {0.0F, 2.0F}, "",
                    "Speed of the small whirls in the wind on cloth, as a share of the wind's speed. 0 blows "
                    "evenly, more makes cloth flutter.")
            .number("eddy_m", &WindStyle::eddy_m, {0.05F, 100.0F}, "m",
                    "Size of the small whirls in the wind on cloth: less makes small ripples, more makes "
                    "large waves");
    return table;
}

} // namespace estampe::wind
