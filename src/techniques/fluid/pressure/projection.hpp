// SPDX-License-Identifier: MIT
#pragma once

// Makes a velocity divergence-free (projection): solves for a pressure, and subtracts the pressure's
// gradient.

#include <cstdint>
#include <optional>
#include <string_view>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

enum class Solver : uint8_t {
    automatic, ///< spectral solver where possible, else multigrid
    jacobi,    ///< Jacobi's iteration: cheap, but leaves large-scale divergence
    multigrid, ///< multigrid with V(2,2) cycles
    spectral,  ///< direct solve by fast transforms; requires sizes that are powers of two and no obstacles
    mass       ///< no solve: the fluid has a mass, advected with both_ways, and accelerates away from mass
};

/// Name of a pressure solver: "jacobi", "multigrid", "spectral", "mass" or "automatic".
[[nodiscard]] const char* name_of(Solver solver);

struct ProjectionStyle {
    Solver solver = Solver::automatic;
    uint32_t jacobi_rounds = 80;
    /// Number of projections per step. Each projection measures the remaining divergence and solves for a
    /// pressure from zero. So further projections reduce the rounding error of floats; further cycles of one
    /// solve would not. 0 selects the solver's default: 3 V-cycles in 2D, 2 in 3D, or one solve with another
    /// solver.
    uint32_t projections = 0;
};

/// Solid cells of the grid, one word per cell: 0 is fluid, other values are a solid.
struct Solids {
    gpu::BufferId cells;
    bool are_any = false;
};

struct Projected {
    gpu::ImageId velocity;
    gpu::ImageId reflected; ///< 2 * projected velocity - velocity before; or `velocity` itself
};

/// Replaces Solver::automatic by the solver that is used for a grid. Throws std::logic_error if `solver`
/// cannot solve the pressure on the grid.
[[nodiscard]] Solver solver_for(const Grid& grid, Solver solver, bool has_solids);

/// Data of the pressure solvers that does not depend on the flow.
struct SolverTables {
    Solids solids;
    gpu::BufferId weights; ///< openings of cell faces, from add_weights()
    gpu::BufferId angles;  ///< cosines and sines for the spectral solver, from upload_angles()
};

/// Adds passes that compute the openings of cell faces on all multigrid levels, for the iterative solvers.
/// The openings depend on walls and obstacles only.
[[nodiscard]] gpu::BufferId add_weights(gpu::Graph& graph, const Grid& grid, const Solids& solids);

/// Outflow that a projection leaves, because hot fluid expands; made by add_swelling().
struct Swelling {
    gpu::BufferId wanted; ///< outflow of each cell in metres per second, or the mass that it gains
    gpu::BufferId share;  ///< one number: what a cell at the rim lets out, in units of `wanted`
    Solids solids;
    float rim_cells = 0.0F; ///< thickness of the rim in cells; 0: each cell lets out the share
};

struct ProjectionInput {
    gpu::ImageId velocity;
    SolverTables tables;
    gpu::ImageId target; ///< overwritten with the projected velocity
    std::optional<Swelling> swelling = {};
};

/// Whether a graph pass with the name `pass` belongs to a projection; excludes the passes of add_weights().
[[nodiscard]] bool is_of_projection(std::string_view pass);

[[nodiscard]] Projected add_projection(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                                       const ProjectionInput& input, bool reflects);

/// Number of graph passes that a projection takes. If the fluid expands, each measurement of the divergence
/// costs a pass more.
[[nodiscard]] uint32_t passes_of_projection(const Grid& grid, const ProjectionStyle& style, bool has_solids,
                                            bool expands);

/// Adds passes that solve for the pressure of each cell from the cells' outflow.
[[nodiscard]] gpu::BufferId add_pressure(gpu::Graph& graph, const Grid& grid, const ProjectionStyle& style,
                                         gpu::BufferId divergence, const SolverTables& tables);

/// Adds a pass that computes each cell's outflow in metres per second: divergence times the cell size.
[[nodiscard]] gpu::BufferId add_divergence(gpu::Graph& graph, const Grid& grid, gpu::ImageId velocity,
                                           const Solids& solids, const char* name = "fluid/divergence");

/// Relative residual of the pressure solver after one solve of a random divergence without obstacles: root
/// mean squares in double precision. Costs a solve and a wait; meant for the start of a program.
[[nodiscard]] double measured_residual(gpu::Device& device, gpu::Executor& executor, const Grid& grid,
                                       const ProjectionStyle& style);

} // namespace estampe::fluid
