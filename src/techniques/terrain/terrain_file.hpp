// SPDX-License-Identifier: MIT
#pragma once

// The parameters of a terrain file except its nodes, as tables. Each parameter is described once.

#include <estampe/terrain.hpp>

#include "style/parameter.hpp"

namespace estampe::terrain {

[[nodiscard]] const style::Table<TerrainLook>& look_table();

[[nodiscard]] const style::Table<TerrainWind>& wind_table();

[[nodiscard]] const style::Table<TerrainMeshing>& mesh_table();

[[nodiscard]] const style::Table<TerrainRipples>& ripples_table();

[[nodiscard]] const style::Table<TerrainTrails>& trails_table();

} // namespace estampe::terrain
