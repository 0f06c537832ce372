// SPDX-License-Identifier: MIT
#include "techniques/terrain/drift/drift.hpp"

#include "style/parameter.hpp"

namespace estampe::terrain {

const style::Table<DriftStyle>& drift_table()
{
    static const auto table =
        style::Table<DriftStyle>("drift", "Sand that the wind blows off the crests of a terrain")
            .choice("mode", &DriftStyle::mode,
                    {{"auto", DriftMode::automatic}, {"drawn", DriftMode::drawn}, {"none", DriftMode::none}},
                    "Drawn, none, or (auto) drawn where the terrain's wind is of 6 m/s or more")
            .number("amount", &DriftStyle::amount, {0.0F, 1.0F}, "", "How much of it")
            .number("length_m", &DriftStyle::length_m, {0.05F, 20.0F}, "m", "Of a usual stroke")
            .number("lift_m", &DriftStyle::lift_m, {0.0F, 20.0F}, "m", "How high it rises at most")
            .number("width_mm", &DriftStyle::width_mm, {0.05F, 5.0F}, "mm", "Of a stroke in its middle")
            .number("reach_m", &DriftStyle::reach_m, {5.0F, 1000.0F}, "m", "How far it is drawn")
            .color("ink", &DriftStyle::ink, "Colour of the strokes");
    return table;
}

} // namespace estampe::terrain
