// SPDX-License-Identifier: MIT
#include "techniques/cloth/cloth_style.hpp"

#include "style/parameter.hpp"

namespace estampe::cloth {

const style::Table<WindStyle>& wind_table()
{
    static const auto table =
        style::Table<WindStyle>("wind", "What moves cloth")
            .choice(
                "from", &WindStyle::from,
                {{"auto", WindSource::automatic}, {"style", WindSource::style}, {"smoke", WindSource::smoke}},
                "Whose speed and direction: (auto) the terrain's where the scene has one, or the style's; "
                "(smoke) within the boxes that smoke rises in that of its air, elsewhere the style's")
            .number("speed_m_s", &WindStyle::speed_m_s, {0.0F, 60.0F}, "m/s", "How fast, on the whole")
            .number("blown_m", &WindStyle::blown_m, {-1.0F, 1e7F}, "m",
                    "How far it has blown, where its speed changes from picture to picture; -1: its speed "
                    "times the time")
            .number("direction_deg", &WindStyle::direction_deg, {-360.0F, 360.0F}, "deg",
                    "Where it blows to: 0 is +x, 90 is +z")
            .number("gustiness", &WindStyle::gustiness, {0.0F, 1.0F}, "",
                    "How much of its speed comes and goes")
            .number("gust_m", &WindStyle::gust_m, {0.1F, 1000.0F}, "m", "From one gust to the next, about")
            .number("turbulence", &WindStyle::turbulence, {0.0F, 2.0F}, "",
                    "How fast eddies turn, of its speed")
            .number("eddy_m", &WindStyle::eddy_m, {0.05F, 100.0F}, "m", "How large they are");
    return table;
}

const style::Table<ClothStyle>& cloth_table()
{
    static const auto table =
        style::Table<ClothStyle>("cloth", "Sheets that hang, lie and blow")
            .number("settle_s", &ClothStyle::settle_s, {0.0F, 20.0F}, "s",
                    "How long it has moved, from how it was laid out, when a still or a film begins")
            .number("effort", &ClothStyle::effort, {0.25F, 8.0F}, "",
                    "How finely time is cut: more stretches less and costs as much more")
            .number("rest_mm_s", &ClothStyle::rest_mm_s, {0.0F, 100.0F}, "mm/s",
                    "A sheet that is slower for half a second, in still air, rests until something moves it; "
                    "0: none rests")
            .choice(
                "bodies", &ClothStyle::bodies,
                {{"capsules", ClothBodies::capsules}, {"depth", ClothBodies::depth}},
                "What skinned bodies are to it: (capsules) one about each bone; (depth) what lies between "
                "their front and their back, as they are seen where they are thinnest");
    return table;
}

} // namespace estampe::cloth
