// SPDX-License-Identifier: MIT
// The one wind of a scene, told to the parts of a style that it moves.
#pragma once

#include "estampe/terrain.hpp"
#include "features/common/style_tables.hpp"

#include <optional>

namespace estampe::features {

/// The wind of `style` over `terrain`: where wind.from is auto and there is a terrain, speed and direction
/// are those of the terrain's file.
[[nodiscard]] wind::WindStyle wind_over(const std::optional<Terrain>& terrain, const wind::WindStyle& style);

/// Sets the section [wind] of `style` to the wind over `terrain` and tells it hatching, clouds, smoke and
/// particles. Returns `style` itself, if
/// the wind is what they assume by default, or else `room` with the changed style. `style` may be `room`.
[[nodiscard]] const StyleTables& with_wind(const StyleTables& style, const std::optional<Terrain>& terrain,
                                           StyleTables& room);

} // namespace estampe::features
