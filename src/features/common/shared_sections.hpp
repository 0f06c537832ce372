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

/// Tells the parts of `style` what they take from sections that several of them share: the wind over
/// `terrain` (hatching, clouds, smoke, particles, and the section [wind] itself), and the fading of paint and
/// hatching with distance from [haze]. Returns `style` itself if all of it is the default, or else `room`
/// with the changed style. `style` may be `room`.
[[nodiscard]] const StyleTables&
with_shared_sections(const StyleTables& style, const std::optional<Terrain>& terrain, StyleTables& room);

} // namespace estampe::features
