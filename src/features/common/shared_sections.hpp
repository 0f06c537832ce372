// SPDX-License-Identifier: MIT
// Sections of a style that several features read: the wind, and the haze.
#pragma once

#include "estampe/terrain.hpp"
#include "features/common/style_tables.hpp"

#include <optional>

namespace estampe::features {

/// The wind of `style` over `terrain`: where wind.from is auto and there is a terrain, speed and direction
/// are those of the terrain's file.
[[nodiscard]] wind::WindStyle wind_over(const std::optional<Terrain>& terrain, const wind::WindStyle& style);

/// Copies sections that several features read to the tables of those features: the wind over `terrain` to
/// hatch, clouds, smoke, particles and wind, and the fading of paint and hatching in haze to wash and hatch.
/// Returns `style` itself if wind and fading have their default values, or else `room` with the changed
/// style. `style` may be `room`.
[[nodiscard]] const StyleTables&
with_shared_sections(const StyleTables& style, const std::optional<Terrain>& terrain, StyleTables& room);

} // namespace estampe::features
