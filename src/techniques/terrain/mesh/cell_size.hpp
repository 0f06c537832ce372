// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/terrain.hpp>

namespace estampe::terrain {

/// The finest cell as it is: a power of two, so that places of vertices are exact numbers.
[[nodiscard]] double cell_of(const TerrainMeshing& meshing);

/// Cells along a side as they are: a multiple of four, at least `least`.
[[nodiscard]] uint32_t cells_of(const TerrainMeshing& meshing, uint32_t least);

} // namespace estampe::terrain
