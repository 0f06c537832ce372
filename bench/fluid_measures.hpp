// SPDX-License-Identifier: MIT
#pragma once

// What programs that measure fluids share.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "common/measuring.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::bench {

/// Square root of the sum of squares.
inline double norm(std::span<const float> numbers)
{
    double sum = 0.0;
    for (const float number : numbers) {
        sum += static_cast<double>(number) * static_cast<double>(number);
    }
    return std::sqrt(sum);
}

/// Runs `graph`. Returns the norm of the outflow of all cells, in metres per second.
inline double divergence_of(Machine& machine, const fluid::Grid& grid, gpu::Graph& graph,
                            gpu::ImageId velocity, const fluid::Solids& solids)
{
    const gpu::BufferId divergence = fluid::add_divergence(graph, grid, velocity, solids);
    gpu::Buffer host(machine.device, "divergence", graph.describe(divergence).size_bytes,
                     gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "divergence", divergence, host);
    machine.executor.run(graph);
    return norm(gpu::items_of<float>(host));
}

/// Brightness of paper below smoke of this density.
inline uint8_t gray_of(float density)
{
    const double light = std::exp(-2.0 * std::max(static_cast<double>(density), 0.0));
    return static_cast<uint8_t>(std::lround(255.0 * std::pow(light, 1.0 / 2.2)));
}

} // namespace estampe::bench
