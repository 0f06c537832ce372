// SPDX-License-Identifier: MIT
#pragma once

// Makes a velocity one without divergence: of a pressure, found by one of several solvers, the gradient is
// taken away.

#include <cstdint>
#include <string_view>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

enum class Solver : uint8_t {
    automatic, ///< spectral where it can be, else multigrid
    jacobi,    ///< rounds of Jacobi's iteration: cheap, and blind to what is large
    multigrid, ///< V(2,2) cycles
    spectral   ///< direct, by fast transforms: sizes that are powers of two, no obstacles
};

/// "jacobi", "multigrid", "spectral" or "automatic".
[[nodiscard]] const char* name_of(Solver solver);

struct ProjectionStyle {
    Solver solver = Solver::automatic;
    uint32_t jacobi_rounds = 80;
    /// How often: each time what divergence is left is measured anew, and solved for from zero. That gets
    /// past the rounding of floats, where more cycles of one solve would not. 0 leaves it to the solver: 3 V
    /// cycles, or one solve of another.
    uint32_t projections = 0;
};

/// Cells that hold no fluid: a word each, 0 for fluid.
struct Solids {
    gpu::BufferId cells;
    bool are_any = false;
};

struct Projected {
    gpu::ImageId velocity;
    gpu::ImageId reflected; ///< the velocity before, reflected in the projected one; itself, if not asked for
};

/// What `automatic` is for such a grid; throws std::logic_error when `solver` cannot do it.
[[nodiscard]] Solver solver_for(const Grid& grid, Solver solver, bool has_solids);

/// What solvers know of a grid whatever flows on it.
struct SolverTables {
    Solids solids;
    gpu::BufferId weights; ///< of add_weights
    gpu::BufferId angles;  ///< of upload_angles
};

/// Openings of faces on all levels, which the iterating solvers want; they depend on walls and obstacles
/// alone.
[[nodiscard]] gpu::BufferId add_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids);

struct ProjectionInput {
    gpu::ImageId velocity;
    SolverTables tables;
    gpu::ImageId target; ///< is overwritten with the projected velocity
};

/// Whether passes of projections have that name, and nobody else's, but for add_weights().
[[nodiscard]] bool is_of_projection(std::string_view pass);

[[nodiscard]] Projected add_projection(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                                       const ProjectionInput& input, bool reflects);

/// Passes that a projection takes.
[[nodiscard]] uint32_t passes_of_projection(const Grid& grid, const ProjectionStyle& style, bool has_solids);

/// From what flows out of each cell the pressure of each.
[[nodiscard]] gpu::BufferId add_pressure(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                                         gpu::BufferId divergence, const SolverTables& tables);

/// Of each cell, what flows out of it, in metres a second: divergence times the side of a cell.
[[nodiscard]] gpu::BufferId add_divergence(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                           const Solids& solids, const char* name = "fluid/divergence");

/// What one solve of a solver leaves of the equations of a random divergence without obstacles, over that
/// divergence, root mean squares in double precision. Cost: a solve, and a wait; meant for the start of a
/// program.
[[nodiscard]] double measured_residual(gpu::Device& device, gpu::Executor& executor, const Grid& grid,
                                       const ProjectionStyle& style);

} // namespace estampe::fluid
