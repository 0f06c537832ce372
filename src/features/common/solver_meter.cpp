// SPDX-License-Identifier: MIT
#include "features/common/solver_meter.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "gpu/transfers.hpp"

namespace estampe::features {
namespace {

double norm(std::span<const float> numbers)
{
    double sum = 0.0;
    for (const float number : numbers) {
        sum += static_cast<double>(number) * static_cast<double>(number);
    }
    return std::sqrt(sum);
}

} // namespace

void SolverMeter::run(gpu::Graph& graph, const fluid::Fluid& fluid, const fluid::FluidStyle& style,
                      const fluid::FluidFields& fields, uint32_t steps, bool is_last)
{
    if (!measures_) {
        executor_.run(graph);
        return;
    }
    std::vector<gpu::Buffer> divergences;
    if (is_last) {
        const fluid::Grid& grid = fluid.grid();
        for (int i = 0; i < 2; ++i) {
            divergences.emplace_back(device_, "fluid divergence", sizeof(float) * grid.cell_count(),
                                     gpu::MemoryUse::readback);
        }
        const auto add = [&](gpu::ImageId velocity, gpu::Buffer& host) {
            gpu::BufferId outflow =
                fluid::add_divergence(graph, grid, velocity, fields.solids, "fluid/measure");
            if (fields.swelling) {
                outflow =
                    fluid::add_swelling_to_outflow(graph, grid, *fields.swelling, outflow, "fluid/measure");
            }
            gpu::add_read_back(graph, "fluid/measured", outflow, host);
        };
        add(fields.unprojected, divergences.front());
        add(fields.velocity, divergences.back());
    }
    executor_.run(graph);
    sum_.steps += steps;
    for (const PassTiming& pass : executor_.timings_of_run()) {
        sum_.gpu_ms += fluid::is_of_projection(pass.name) ? pass.gpu_ms : 0.0;
    }
    if (is_last) {
        const double before = norm(gpu::items_of<float>(divergences.front()));
        sum_.solver = fluid::name_of(fluid.solver_of(style));
        sum_.divergence_left = before > 0.0 ? norm(gpu::items_of<float>(divergences.back())) / before : 0.0;
        report_ = sum_;
    }
}

} // namespace estampe::features
