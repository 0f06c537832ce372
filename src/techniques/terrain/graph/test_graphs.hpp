// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace estampe::test {

/// A graph that repeats every 8 m, with every node that can repeat.
inline const std::string periodic_graph = R"toml([terrain]
height = "3 * sine(8) + rotate(sine(2), 90) + noise(0.5) * 0 + lerp(sine(4), translate(sine(1), 0.25, 0), 0.5)"
)toml";

/// Graphs that together contain every node.
inline std::vector<std::pair<std::string, std::string>> all_graphs()
{
    return {
        {"noises", R"toml([terrain]
height = "4 * fbm(40, octaves = 6) + 2 * noise(13, seed = 3) + 3 * ridged(60, octaves = 3, seed = 5)"
)toml"},
        {"cells", R"toml([terrain]
height = "3 * cellular(25) + 0.5 * smoothstep(0.2, 0.9, cellular(11, seed = 2))"
)toml"},
        {"frames", R"toml([terrain]
height = "rotate(scale(5 * noise(10), 2, 4), 33) + translate(2 * sine(9), 3 * time, 1) + downwind(sine(21))"
[wind]
towards_deg = 13
)toml"},
        {"warps", R"toml([terrain]
height = "warp(rotate(4 * sine(30), 50), 6 * noise(40), 5 * noise(40, seed = 1)) + translate(sine(17), noise(50), 0)"
)toml"},
        {"polar", R"toml([terrain]
height = "polar(2 * sine(12) + 0.2 * rotate(sine(31.4159265358979), 90), 31, 17)"
)toml"},
        {"values", R"toml([terrain]
height = "lerp(a, b, sin(time)) + curve(b, -1, 0, 0, 2, 1, 1) + sqrt(4 + a) * (2 + b) ^ 1.5 - min(a, b) / (3 + abs(b)) + max(0.01 * x, cos(0.1 * z)) * wind"
[nodes]
a = "noise(19)"
b = "noise(23, seed = 9)"
)toml"},
        {"dunes", R"toml([terrain]
height = "dunes(70, 6, celerity = 0.5) + dunes(14, 0.5, celerity = 0.9, seed = 4) + 2 * fbm(300, octaves = 2)"
[wind]
towards_deg = 65
)toml"},
    };
}

} // namespace estampe::test
