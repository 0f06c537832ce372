// SPDX-License-Identifier: MIT
#pragma once

// Mass that is counted in whole units, so that advection conserves it exactly, even if the flow has
// divergence.

#include <span>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

enum class MassAdvection : uint8_t {
    forward,  ///< each cell distributes its mass over the cells around the point where the flow takes it
    both_ways ///< each cell claims mass from where the flow comes from; claims are scaled down to the
              ///< existing mass, and unclaimed mass is moved as by `forward`
};

/// Mass of each cell in units of 1 / 65536. The sum is constant to the unit, and no cell is negative; a cell
/// holds up to 65535. The result does not depend on the order of threads.
class MassField {
public:
    /// `mass` has one number from 0 to 32768 per cell; otherwise std::logic_error is thrown.
    MassField(gpu::Device& device, const Grid& grid, std::span<const float> mass);

    [[nodiscard]] gpu::BufferId import(gpu::Graph& graph);

    /// Returns the mass after `time_s` of a flow. `mass` comes from import() or add_step(). Pass the last
    /// result in a graph to keep().
    [[nodiscard]] gpu::BufferId add_step(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity,
                                         float time_s, MassAdvection advection) const;

    void keep(gpu::Graph& graph, gpu::BufferId mass);

    /// Returns the velocity after `time_s` of acceleration away from mass, as in a compressible gas.
    /// `stiffness_m2_s2` is the square of the speed of sound where cells have mass 1. Replaces the pressure
    /// solve.
    [[nodiscard]] gpu::ImageId add_spread(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity,
                                          float stiffness_m2_s2, float time_s) const;

private:
    Grid grid_;
    gpu::Buffer units_;
};

} // namespace estampe::fluid
