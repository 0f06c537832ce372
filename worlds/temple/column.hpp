// SPDX-License-Identifier: MIT
#pragma once

// Columns, no two alike.

#include <cstdint>

#include "kit.hpp"

namespace temple {

enum class Order : uint8_t { tuscan, doric, ionic, bell };

struct Column {
    Order order = Order::doric;
    float radius_m = 0.7F; ///< of the shaft at its foot
    float height_m = 7.0F; ///< with base and capital
    int flutes = 20;       ///< 0: none
    float left = 1.0F;     ///< share of the shaft that still stands; 1: with its capital
    float wear = 0.4F;     ///< how much has been chipped off
    float lean_deg = 0.0F;
    float lean_to_deg = 0.0F; ///< bearing, from +z towards +x
    uint64_t chance = 0;
};

/// One as chance has it, whole or broken.
[[nodiscard]] Column throw_column(Dice& dice, float radius_m, float height_m, float ruin);

/// Half the side of its lowest block.
[[nodiscard]] float foot_half_m(const Column& column);

/// On y = 0, about the y axis but for its leaning.
[[nodiscard]] Kit build_column(const Column& column);

/// A piece of a shaft that lies along x on y = 0.
[[nodiscard]] Kit build_drum(float radius_m, float length_m, Dice dice);

} // namespace temple
