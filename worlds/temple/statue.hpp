// SPDX-License-Identifier: MIT
#pragma once

// Figures of stone, of which not much is left. All on y = 0, looking towards +z.

#include "dice.hpp"
#include "kit.hpp"

namespace temple {

/// A giant on a throne, broken at the breast, 9 m to the knees' height of a house.
[[nodiscard]] Kit build_seated(Dice dice);

/// The giant's head, an egg without a face but for a brow and a nose; its middle on y = 0.
[[nodiscard]] Kit build_head(float radius_m);

/// A hand that reaches up, from the wrist on.
[[nodiscard]] Kit build_hand(float length_m);

/// A draped figure on a block, without arms, and perhaps without a head.
[[nodiscard]] Kit build_figure(Dice dice);

} // namespace temple
