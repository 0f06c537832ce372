// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

/// The levels of a grid from the finest on, each of half the cells along each axis, to the first that one
/// workgroup can take with all after it.
[[nodiscard]] std::vector<shared::FluidLevel> levels_of(const Grid& grid);

/// Levels from this one on down to four cells or fewer.
[[nodiscard]] uint32_t small_levels_from(const shared::FluidLevel& level);

[[nodiscard]] inline uint32_t cell_count(const shared::FluidLevel& level)
{
    return level.width * level.height;
}

} // namespace estampe::fluid
