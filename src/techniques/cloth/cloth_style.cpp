// SPDX-License-Identifier: MIT
#include "techniques/cloth/cloth_style.hpp"

#include "style/parameter.hpp"

namespace estampe::cloth {

const style::Table<WindStyle>& wind_table()
{
    static const auto table =
        style::Table<WindStyle>("wind", "Wind that moves cloth")
            .choice(
                "from", &WindStyle::from,
                {{"auto", WindSource::automatic}, {"style", WindSource::style}, {"smoke", WindSource::smoke}},
                "Source of the wind on cloth. auto: the terrain, or style if there is none; style: "
                "wind.speed_m_per_s and wind.direction_deg; smoke: the moving air in smoke boxes, and style "
                "elsewhere.")
            .number("speed_m_per_s", &WindStyle::speed_m_per_s, {0.0F, 60.0F}, "m/s",
                    "Mean speed of the wind on cloth: 0 is still air, 4 a breeze, 15 a storm. Not used when "
                    "wind.from is auto and the scene has a terrain.")
            .number("blown_m", &WindStyle::blown_m, {-1.0F, 1e7F}, "m",
                    "Distance that the wind has already blown, for films in which wind.speed_m_per_s changes "
                    "from frame to frame: without this value, gusts would jump. -1 computes the distance as "
                    "speed times time.")
            .number("direction_deg", &WindStyle::direction_deg, {-360.0F, 360.0F}, "deg",
                    "Direction towards which the wind on cloth blows: 0 is +x, 90 is +z. Not used when "
                    "wind.from is auto and the scene has a terrain.")
            .number("gustiness", &WindStyle::gustiness, {0.0F, 1.0F}, "",
                    "How much the speed of the wind changes in gusts: 0 is steady, 1 changes between calm "
                    "and twice the speed")
            .number("gust_m", &WindStyle::gust_m, {0.1F, 1000.0F}, "m",
                    "Approximate distance from one gust of wind to the next: less makes the wind change more "
                    "often")
            .number("turbulence", &WindStyle::turbulence, {0.0F, 2.0F}, "",
                    "Speed of the eddies (small whirls) in the wind, as a share of the wind's speed: 0 blows "
                    "evenly, more makes cloth flutter")
            .number("eddy_m", &WindStyle::eddy_m, {0.05F, 100.0F}, "m",
                    "Size of the eddies (small whirls) in the wind: less makes small ripples in cloth, more "
                    "makes large waves");
    return table;
}

const style::Table<ClothStyle>& cloth_table()
{
    static const auto table =
        style::Table<ClothStyle>("cloth", "Cloth: sheets of fabric that hang, lie and blow in the wind")
            .number("settle_s", &ClothStyle::settle_s, {0.0F, 20.0F}, "s",
                    "How long cloth has already moved before a still picture or the first frame of a film: 0 "
                    "shows cloth in its starting shape, more lets it hang and settle")
            .number("effort", &ClothStyle::effort, {0.25F, 8.0F}, "",
                    "Number of simulation steps for cloth, as a factor: more makes cloth stretch less and "
                    "takes longer to compute")
            .number("rest_mm_per_s", &ClothStyle::rest_mm_per_s, {0.0F, 100.0F}, "mm/s",
                    "Speed below which cloth stops moving: after half a second below it in still air, cloth "
                    "rests until something moves the cloth. 0 lets no cloth rest.")
            .choice("bodies", &ClothStyle::bodies,
                    {{"capsules", ClothBodies::capsules}, {"depth", ClothBodies::depth}},
                    "Shape of skinned bodies when cloth touches them. capsules: a rounded cylinder around "
                    "each bone; depth: the body between its front and back, seen along its thinnest "
                    "direction, which is more exact.");
    return table;
}

} // namespace estampe::cloth
