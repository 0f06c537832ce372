// SPDX-License-Identifier: MIT
#pragma once

// Walls of stones in courses, with round arches through them, whole or in ruin.

#include <functional>
#include <vector>

#include "kit.hpp"

namespace temple {

/// A round arch through a wall, or with `ring_m` 0 a door under a lintel.
struct Arch {
    float x_m = 0.0F; ///< its middle, along the wall
    float half_m = 1.5F;
    float springing_m = 3.0F; ///< where the round part begins, or the lintel lies
    float ring_m = 0.6F;      ///< depth of its stones

    [[nodiscard]] float crown_m() const { return springing_m + (ring_m > 0.0F ? half_m : 0.0F); }
};

/// A wall along +x from x = 0, its front towards +z, the middle of its thickness on z = 0.
struct Wall {
    float length_m = 10.0F;
    float height_m = 6.0F;
    float thickness_m = 1.0F;
    float foot_m = -4.0F; ///< how deep it stands in the sand
    float course_m = 0.62F;
    float stone_m = 1.35F;
    std::vector<Arch> arches;
    std::function<float(float)> top_m; ///< of what is left, by x; empty: all of it
    float joints = 0.45F;              ///< share of joints that are drawn
    bool cornice = false;
};

/// One stone as it lies: its sides are upright but where an arch cuts them.
struct Stone {
    float low_m, high_m;
    float left_m, right_m;
    int arch_left = -1, arch_right = -1;        ///< what cuts it there
    bool ends_left = false, ends_right = false; ///< the side there is open to the air
};

/// A stone of an arch, between two angles from +x about the middle of its springing.
struct Voussoir {
    int arch = 0;
    float from_rad, to_rad;
    float outer_m;
};

/// A wall before it is built.
struct Laid {
    std::vector<std::vector<Stone>> courses; ///< from the foot up; each from left to right
    std::vector<Voussoir> voussoirs;
    std::vector<bool> is_whole; ///< of each arch
};

/// Decides where each stone lies. No stone is left over that nothing carries.
[[nodiscard]] Laid lay(const Wall& wall, Dice dice);

/// The way from an arch's middle to where the stones of the wall begin, at a height; 0 above the arch.
[[nodiscard]] float cut_half_m(const Arch& arch, float height_m);

[[nodiscard]] Kit build_wall(const Wall& wall, const Laid& laid, Dice dice);

} // namespace temple
