// SPDX-License-Identifier: MIT
#pragma once

// Multigrid and spectral solvers of the pressure equation, and the levels of the multigrid.

#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// The multigrid levels of a grid, finest first. Along each axis, a level has half the number of cells of the
/// previous level. The list ends with the first level that one workgroup can process together with all
/// coarser levels.
[[nodiscard]] std::vector<shared::FluidLevel> levels_of(const Grid& grid);

[[nodiscard]] inline uint32_t cell_count(const shared::FluidLevel& level)
{
    return level.width * level.height;
}

/// The pressure equation: for each cell, sum over the open faces of (neighbour's pressure - cell's pressure)
/// = outflow of the cell.
struct Equation {
    gpu::BufferId divergence;
    Solids solids;
    gpu::BufferId weights; ///< openings of cell faces, from add_weights()
};

/// Adds one multigrid V(2,2) cycle in 2D that starts from zero pressure.
[[nodiscard]] gpu::BufferId add_v_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);

/// Adds one multigrid V(2,2) cycle in 3D that starts from zero pressure. The weights come from
/// add_volume_weights().
[[nodiscard]] gpu::BufferId add_volume_cycle(gpu::Graph& graph, const Grid& grid, const Equation& equation);
[[nodiscard]] gpu::BufferId add_volume_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids);
[[nodiscard]] uint32_t passes_of_volume_cycle(const Grid& grid);

/// Whether the spectral pressure solver can solve a grid: all sizes must be powers of two.
[[nodiscard]] bool is_spectral_possible(const Grid& grid);

/// Uploads cosines and sines for the transforms of a grid; a placeholder if the spectral solver is not
/// possible.
[[nodiscard]] gpu::Buffer upload_angles(gpu::Device& device, const Grid& grid);

/// Adds the spectral solver, which solves the pressure directly by transforms along each axis. Requires that
/// there are no obstacles.
[[nodiscard]] gpu::BufferId add_spectral(gpu::Graph& graph, const Grid& grid, const Equation& equation,
                                         gpu::BufferId angles);

} // namespace estampe::fluid
