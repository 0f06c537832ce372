// SPDX-License-Identifier: MIT
#pragma once

#include "dice.hpp"
#include "kit.hpp"

namespace temple {

/// A square block of masonry beside the gate, its walls leaning in; in ruin its top has come down.
[[nodiscard]] Kit build_pylon(float height_m, bool is_ruin, Dice dice);

/// A square tower under a ring of columns, 34 m high.
[[nodiscard]] Kit build_tower(Dice dice);

} // namespace temple
