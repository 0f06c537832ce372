// SPDX-License-Identifier: MIT
#pragma once

// Mass that a flow carries and never loses, whether the flow has divergence or not: counted in whole units.

#include <span>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"

namespace estampe::fluid {

enum class MassAdvection : uint8_t {
    forward,  ///< each cell gives what it has to the cells about where the flow takes it
    both_ways ///< each cell takes what comes to it, no cell gives more than it has, and what nobody takes
              ///< goes forward
};

/// Mass of each cell in units of 1 / 65536. The sum stays what it is, to the unit, and none is less than
/// zero; a cell holds up to 65535. The order of threads does not matter.
class MassField {
public:
    /// `mass` is a number of 0 to 32768 for each cell; anything else is an std::logic_error.
    MassField(gpu::Device& device, const Grid& grid, std::span<const float> mass);

    [[nodiscard]] gpu::BufferId import(gpu::Graph& graph);

    /// `mass`, of import() or of this, after `time_s` of a flow; the last of a graph is to be kept().
    [[nodiscard]] gpu::BufferId add_step(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity,
                                         float time_s, MassAdvection advection) const;

    /// Keeps it for the next graph.
    void keep(gpu::Graph& graph, gpu::BufferId mass);

    /// A velocity in metres a second after `time_s` of running away from mass: `stiffness_m2_s2` is the
    /// square of the speed of sound where the mass of cells is 1. With it mass needs no pressure, and is
    /// compressible.
    [[nodiscard]] gpu::ImageId add_spread(gpu::Graph& graph, gpu::BufferId mass, gpu::ImageId velocity,
                                          float stiffness_m2_s2, float time_s) const;

private:
    Grid grid_;
    gpu::Buffer units_;
};

} // namespace estampe::fluid
