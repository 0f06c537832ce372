// SPDX-License-Identifier: MIT
#pragma once

// The usual solvers of the pressure's equation, and the ever coarser levels of a grid that multigrid goes
// through.

#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// The levels of a grid from the finest on, each of half the cells along each axis, to the first that one
/// workgroup can take with all after it.
[[nodiscard]] std::vector<shared::FluidLevel> levels_of(const Grid& grid);

[[nodiscard]] inline uint32_t cell_count(const shared::FluidLevel& level)
{
    return level.width * level.height;
}

/// The pressure's equation: from what flows out of each cell the pressure of each cell, such that the sum
/// over a cell's open faces of pressure there less pressure here is what flows out.
struct Equation {
    gpu::BufferId divergence;
    Solids solids;
    gpu::BufferId weights; ///< of add_weights
};

/// One V(2,2) cycle from zero, in two dimensions.
[[nodiscard]] gpu::BufferId add_v_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);

/// The same for volumes, with weights of add_volume_weights.
[[nodiscard]] gpu::BufferId add_volume_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);
[[nodiscard]] gpu::BufferId add_volume_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids);
[[nodiscard]] uint32_t passes_of_volume_cycle(const Grid& grid);

/// Sizes that are powers of two.
[[nodiscard]] bool is_spectral_possible(const Grid& grid);

/// Cosines and sines for the transforms of a grid; nothing of use when they are not possible.
[[nodiscard]] gpu::Buffer upload_angles(gpu::Device& device, const Grid& grid);

/// Directly, by transforms of rows and columns; there are no obstacles.
[[nodiscard]] gpu::BufferId add_spectral(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                         gpu::BufferId angles);

} // namespace estampe::fluid
