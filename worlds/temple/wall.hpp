// SPDX-License-Identifier: MIT
#pragma once

// Walls of stones in courses (rows), with round arches, whole or in ruin.

#include <functional>
#include <vector>

#include "kit.hpp"

namespace temple {

/// An opening of a wall: a round arch; if `ring_m` is 0, a door under a horizontal lintel.
struct Arch {
    float x_m = 0.0F; ///< Middle of the arch along the wall
    float half_m = 1.5F;
    float springing_m = 3.0F; ///< Height where the arch's curve begins, or where the lintel lies
    float ring_m = 0.6F;      ///< Radial depth of the stones of the arch

    [[nodiscard]] float crown_m() const { return springing_m + (ring_m > 0.0F ? half_m : 0.0F); }
};

/// A wall along +x from x = 0. The wall's front faces +z, and z = 0 is the middle of the wall's thickness.
struct Wall {
    float length_m = 10.0F;
    float height_m = 6.0F;
    float thickness_m = 1.0F;
    float foot_m = -4.0F; ///< Lowest height of the wall, below the sand's surface
    float course_m = 0.62F;
    float stone_m = 1.35F;
    std::vector<Arch> arches;
    std::function<float(float)> top_m; ///< Height of the remaining wall at x; empty for an undamaged wall
    float joints = 0.45F;              ///< Share of the joints between stones that are drawn
    bool cornice = false;
};

/// A stone of a wall, in its place. The stone's sides are vertical except where an arch cuts them.
struct Stone {
    float low_m, high_m;
    float left_m, right_m;
    int arch_left = -1, arch_right = -1;        ///< Arch that cuts the left or right side of the stone
    bool ends_left = false, ends_right = false; ///< No other stone touches the left or right side
};

/// A stone of an arch, between two angles counter-clockwise from +x around the centre of the arch.
struct Voussoir {
    int arch = 0;
    float from_rad, to_rad;
    float outer_m;
};

/// Layout of a wall's stones, before the wall is built.
struct Laid {
    /// Stones of the wall: courses from bottom to top, each from left to right.
    std::vector<std::vector<Stone>> courses;
    std::vector<Voussoir> voussoirs;
    std::vector<bool> is_whole; ///< For each arch: true if it is not broken
};

/// Decides where each stone of a wall lies. Removes stones that have no support.
[[nodiscard]] Laid lay(const Wall& wall, Dice dice);

/// Returns the horizontal distance, at a height, from the middle of an arch to the nearest stones of the
/// wall. Above the arch the distance is 0.
[[nodiscard]] float cut_half_m(const Arch& arch, float height_m);

[[nodiscard]] Kit build_wall(const Wall& wall, const Laid& laid, Dice dice);

} // namespace temple
