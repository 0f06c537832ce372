// SPDX-License-Identifier: MIT
#pragma once

// Expansion of hot fluid: the projection leaves an outflow where the fluid is hotter than a threshold.

#include <optional>

#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/matter/matter.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// Fluid that may expand in a step of `step_s`.
struct Hot {
    gpu::ImageId quantities; ///< the quantities of the fluid; channel 1 is the temperature
    Solids solids;
    std::optional<gpu::BufferId> mass = {}; ///< mass of each cell, for Solver::mass
    float step_s = 0.0F;
};

/// Adds two passes that find out how much each cell expands in a step. The excess E of the temperature above
/// `style.expands_above`, X, obeys dE/dt = -k E, where k is `style.expansion_per_s`. The heat of a piece of
/// fluid, its temperature T times its volume, does not change. So the fluid expands at the rate
/// k (1 - X / T), which is less than k, and in all by the factor T / X. The whole volume gained leaves
/// through the rim of `style`, or evenly through all cells of a grid without a rim, whose fluid is
/// compressed.
///
/// Source  Feldman, O'Brien and Arikan, "Animating suspended particle explosions", ACM Transactions on
///         Graphics 22, 2003, for a projection that leaves a divergence; the law of the rate is this
///         project's own
/// Cost    a dispatch over the cells, and one workgroup that sums one number per 64 cells
[[nodiscard]] Swelling add_swelling(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                    const Hot& hot);
inline constexpr uint32_t passes_of_swelling = 2;

/// Adds a pass called `name` that subtracts the wanted outflow from `outflow`, which add_divergence()
/// computed. A projection then removes only the remaining outflow.
[[nodiscard]] gpu::BufferId add_swelling_to_outflow(gpu::Graph& graph, const Grid& grid,
                                                    const Swelling& swelling, gpu::BufferId outflow,
                                                    const char* name = "fluid/swell");

/// Adds a pass that returns `mass` with the mass of the expansion, for Solver::mass.
[[nodiscard]] gpu::BufferId add_swelling_to_mass(gpu::Graph& graph, const Grid& grid,
                                                 const Swelling& swelling, gpu::BufferId mass);

} // namespace estampe::fluid
