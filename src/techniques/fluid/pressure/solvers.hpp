// SPDX-License-Identifier: MIT
#pragma once

// Multigrid and spectral solvers of the pressure equation, and the levels of the multigrid.

#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// The levels of a grid, finest first; each has half the cells of the previous one along each axis. The list
/// ends with the first level that one workgroup can process together with all coarser ones.
[[nodiscard]] std::vector<shared::FluidLevel> levels_of(const Grid& grid);

[[nodiscard]] inline uint32_t cell_count(const shared::FluidLevel& level)
{
    return level.width * level.height;
}

/// The pressure equation: for each cell, the sum over its open faces of the neighbour's pressure minus its
/// own is the cell's outflow.
struct Equation {
    gpu::BufferId divergence;
    Solids solids;
    gpu::BufferId weights; ///< from add_weights
};

/// Adds one V(2,2) cycle from zero in 2D.
[[nodiscard]] gpu::BufferId add_v_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);

/// Adds one V(2,2) cycle from zero in 3D; the weights come from add_volume_weights.
[[nodiscard]] gpu::BufferId add_volume_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);
[[nodiscard]] gpu::BufferId add_volume_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids);
[[nodiscard]] uint32_t passes_of_volume_cycle(const Grid& grid);

/// Requires that all sizes are powers of two.
[[nodiscard]] bool is_spectral_possible(const Grid& grid);

/// Cosines and sines for the transforms of a grid; a placeholder if the spectral solver is not possible.
[[nodiscard]] gpu::Buffer upload_angles(gpu::Device& device, const Grid& grid);

/// Solves directly, by transforms along each axis. Requires that there are no obstacles.
[[nodiscard]] gpu::BufferId add_spectral(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                         gpu::BufferId angles);

} // namespace estampe::fluid
