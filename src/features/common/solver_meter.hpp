// SPDX-License-Identifier: MIT
#pragma once

// What the pressure solver of a fluid does in the steps of a picture.

#include <optional>
#include <string>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::features {

class SolverMeter {
public:
    /// One that does not measure runs graphs, and nothing else.
    SolverMeter(gpu::Device& device, gpu::Executor& executor, bool measures)
        : device_(device), executor_(executor), measures_(measures)
    {
    }

    /// Runs a graph that ends with so many steps of `fluid`. Of the last graph of a picture the divergence is
    /// read. Cost, where it measures: two passes of the last graph, and two numbers a cell from the device.
    void run(gpu::Graph& graph, const fluid::Fluid& fluid, const fluid::FluidStyle& style,
             const fluid::FluidFields& fields, uint32_t steps, bool is_last);

    /// None before the last graph, and where nothing is measured.
    [[nodiscard]] std::optional<SolverReport> report() const { return report_; }

private:
    gpu::Device& device_;
    gpu::Executor& executor_;
    bool measures_;
    SolverReport sum_;
    std::optional<SolverReport> report_;
};

} // namespace estampe::features
