// SPDX-License-Identifier: MIT
#pragma once

// What stands outside of the prison: the court with its arcades, the gate, towers, columns, statues, flags.
// Towers and statues stand on y = 0, looking towards +z.

#include <vector>

#include "kit.hpp"
#include "plan.hpp"
#include "prison.hpp"

namespace temple {

inline constexpr float court_west_m = -21.0F;
inline constexpr float court_east_m = 22.0F;
inline constexpr float court_south_m = 27.0F;
inline constexpr float stairs_foot_m = -16.9F; ///< z of the lowest step before the portal
inline constexpr float stairs_half_m = 15.0F;

/// Half of the court's gate is to either side of x = 0.
inline constexpr float gate_half_m = 3.2F;

struct StandingColumn {
    glm::vec2 place_m{0.0F};
    float foot_m = 0.0F;      ///< height of its foot, over the sand
    bool is_on_floor = false; ///< it stands on stone: the foot's height is that over the court
    Column column;
};

/// A sheet that hangs or flies; held along the side where it begins.
struct Sheet {
    glm::vec3 corner_m{0.0F};
    glm::vec3 along_m{1.0F, 0.0F, 0.0F};
    glm::vec3 down_m{0.0F, -1.0F, 0.0F};
    bool is_held_above = false;
};

/// The things that stand about.
struct Site {
    std::vector<StandingColumn> columns; ///< of portico, court and avenue
    std::vector<glm::vec3> drums;        ///< x, z and the bearing in degrees
    std::vector<Sheet> sheets;
    std::vector<Thing> things;
    glm::vec2 colossus_m{0.0F};
    glm::vec2 tower_m{0.0F};
};

/// The columns of portico, court and avenue: the portico's first, from the west.
[[nodiscard]] std::vector<StandingColumn> stand_columns(uint64_t seed);

[[nodiscard]] Site make_site(uint64_t seed);

} // namespace temple
