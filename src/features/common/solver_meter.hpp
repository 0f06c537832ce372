// SPDX-License-Identifier: MIT
#pragma once

// Measures the pressure solver of a fluid: the GPU time, and the divergence that remains after the solve.

#include <optional>
#include <string>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::features {

class SolverMeter {
public:
    /// Creates a meter for the solver of one fluid. If `measures` is false, run() only runs graphs.
    SolverMeter(gpu::Device& device, gpu::Executor& executor, bool measures)
        : device_(device), executor_(executor), measures_(measures)
    {
    }

    /// Runs a graph that ends with `steps` steps of `fluid`. Reads the divergence back after the last graph
    /// of a picture. Cost when measuring: two passes in the last graph, and a read-back of two numbers per
    /// cell.
    void run(gpu::Graph& graph, const fluid::Fluid& fluid, const fluid::FluidStyle& style,
             const fluid::FluidFields& fields, uint32_t steps, bool is_last);

    /// Returns the report of the measured solver. Returns none before the last graph has run, or if nothing
    /// is measured.
    [[nodiscard]] std::optional<SolverReport> report() const { return report_; }

private:
    gpu::Device& device_;
    gpu::Executor& executor_;
    bool measures_;
    SolverReport sum_;
    std::optional<SolverReport> report_;
};

} // namespace estampe::features
