// SPDX-License-Identifier: MIT
#include "techniques/haze/haze.hpp"

#include "style/parameter.hpp"

namespace estampe::haze {

const style::Table<HazeStyle>& haze_table()
{
    static const auto table =
        style::Table<HazeStyle>("haze", "What is far fades into the sky")
            .choice("mode", &HazeStyle::mode,
                    {{"auto", HazeMode::automatic}, {"drawn", HazeMode::drawn}, {"none", HazeMode::none}},
                    "Drawn, none, or (auto) drawn where the scene has a terrain")
            .number("start_m", &HazeStyle::start_m, {0.0F, 1e6F}, "m", "Nearer than this all is clear")
            .number("reach_m", &HazeStyle::reach_m, {0.01F, 1e6F}, "m",
                    "Farther than that by this, half is gone; by twice as much, three quarters")
            .number("ink", &HazeStyle::ink, {0.0F, 16.0F}, "",
                    "How many times as soon strokes and lines are gone; 0 keeps them");
    return table;
}

} // namespace estampe::haze
