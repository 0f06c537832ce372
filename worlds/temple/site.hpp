// SPDX-License-Identifier: MIT
#pragma once

// The temple's site outside the prison: the court with its arcades, the gate, towers, columns, statues,
// flags. Towers and statues stand on y = 0 and face +z.

#include <vector>

#include "kit.hpp"
#include "plan.hpp"
#include "prison.hpp"

namespace temple {

inline constexpr float court_west_m = -21.0F;
inline constexpr float court_east_m = 22.0F;
inline constexpr float court_south_m = 27.0F;
inline constexpr float stairs_foot_m = -16.9F; ///< z of the lowest step of the stairs in front of the portal
inline constexpr float stairs_half_m = 15.0F;

/// Half the width of the court's gate, which is centred on x = 0.
inline constexpr float gate_half_m = 3.2F;

struct StandingColumn {
    glm::vec2 place_m{0.0F};
    float foot_m = 0.0F;      ///< Height of the column's foot above the sand
    bool is_on_floor = false; ///< The column stands on stone: `foot_m` is the height above the court
    Column column;
};

/// A flag or banner: a cloth sheet that is held along the edge where it begins.
struct Sheet {
    glm::vec3 corner_m{0.0F};
    glm::vec3 along_m{1.0F, 0.0F, 0.0F};
    glm::vec3 down_m{0.0F, -1.0F, 0.0F};
    bool is_held_above = false;
};

/// The objects of the temple outside the prison.
struct Site {
    std::vector<StandingColumn> columns; ///< Columns of portico, court and avenue
    std::vector<glm::vec3> drums;        ///< Drums of fallen columns: x, z and the bearing in degrees
    std::vector<Sheet> sheets;
    std::vector<Thing> things;
    glm::vec2 colossus_m{0.0F};
    glm::vec2 tower_m{0.0F};
};

/// Returns the columns of portico, court and avenue. The portico's columns come first, from west to east.
[[nodiscard]] std::vector<StandingColumn> stand_columns(uint64_t seed);

[[nodiscard]] Site make_site(uint64_t seed);

} // namespace temple
