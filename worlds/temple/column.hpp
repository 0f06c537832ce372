// SPDX-License-Identifier: MIT
#pragma once

// Columns with random proportions and damage, so that no two are alike.

#include <cstdint>

#include "kit.hpp"

namespace temple {

enum class Order : uint8_t { tuscan, doric, ionic, bell };

struct Column {
    Order order = Order::doric;
    float radius_m = 0.7F; ///< Radius of the column's shaft at its foot
    float height_m = 7.0F; ///< Height of the column including base and capital
    int flutes = 20;       ///< Number of flutes; 0 for a plain shaft
    float left = 1.0F;     ///< Share of the column's height that still stands; 1 includes the capital
    float wear = 0.4F;     ///< How much of the column has been chipped off, 0 to 1
    float lean_deg = 0.0F;
    float lean_to_deg = 0.0F; ///< Direction in which the column leans, in degrees: 0 is +z, 90 is +x
    uint64_t chance = 0;
};

/// Chooses the proportions and the damage of a column at random.
[[nodiscard]] Column throw_column(Dice& dice, float radius_m, float height_m, float ruin);

/// Returns half the side length of the column's lowest block.
[[nodiscard]] float foot_half_m(const Column& column);

/// Builds a column that stands on y = 0; its axis is y unless it leans.
[[nodiscard]] Kit build_column(const Column& column);

/// Builds a piece of a column's shaft that lies along x on y = 0.
[[nodiscard]] Kit build_drum(float radius_m, float length_m, Dice dice);

} // namespace temple
