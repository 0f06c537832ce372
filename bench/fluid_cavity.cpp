// SPDX-License-Identifier: MIT
// The lid-driven cavity until it stands still, against Ghia, Ghia and Shin. estampe_bench_fluid_cavity --help

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "techniques/fluid/cavity.hpp"
#include "techniques/fluid/fluid.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    int reynolds = 1000;
    uint32_t side = 128;
    double time_s = 50.0;
    double courant = 0.5;
    fluid::Advection advection = fluid::Advection::maccormack;
    fluid::Stepping stepping = fluid::Stepping::reflect;
    fluid::Solver solver = fluid::Solver::automatic;
};

void measure(const Options& options)
{
    bench::Machine machine(options.device);
    const fluid::Grid grid = fluid::cavity_grid(options.side);
    fluid::Fluid cavity(machine.device, grid);
    const fluid::FluidStyle style{.step_s = static_cast<float>(options.courant / options.side),
                                  .stepping = options.stepping,
                                  .velocity_advection = options.advection,
                                  .projection = {.solver = options.solver},
                                  .viscosity_m2_s = 1.0F / static_cast<float>(options.reynolds)};
    const auto steps = static_cast<uint32_t>(options.time_s * options.side / options.courant);
    const bench::WallClock clock;
    constexpr uint32_t reports = 10;
    uint32_t taken = 0;
    uint32_t reported = 0;
    bench::in_batches(steps, cavity.most_steps(style), [&](uint32_t count, bool /*is_last*/) {
        gpu::Graph graph;
        const fluid::FluidFields fields = cavity.add_steps(graph, style, count);
        taken += count;
        if (taken * reports / steps == reported) {
            machine.executor.run(graph);
            return;
        }
        reported = taken * reports / steps;
        const std::vector<float> velocity =
            fluid::run_and_read(machine.device, machine.executor, graph, fields.velocity);
        const fluid::CavityFit fit = fluid::cavity_fit(grid, velocity, options.reynolds);
        fmt::print("after {:6.2f} s: rms of u {:.4f}, of v {:.4f}; u from {:.4f}, v from {:.4f} to {:.4f}\n",
                   static_cast<double>(taken) * static_cast<double>(style.step_s), fit.rms_u, fit.rms_v,
                   fit.least_u, fit.least_v, fit.most_v);
        static_cast<void>(std::fflush(stdout));
    });
    fmt::print("{}: {} steps of {:.3f} ms\n", machine.name(), steps, clock.ms() / steps);
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Lets the lid of a cavity drive the fluid in it, and compares with the literature",
                 "estampe_bench_fluid_cavity");
    bench::add_device_option(app, options.device);
    app.add_option("--reynolds", options.reynolds)->check(CLI::IsMember({100, 400, 1000}));
    app.add_option("--side", options.side, "Cells");
    app.add_option("--time-s", options.time_s);
    app.add_option("--courant", options.courant, "Cells that the lid goes in a step");
    app.add_option("--advection", options.advection)
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, fluid::Advection>{{"linear", fluid::Advection::linear},
                                                    {"cubic", fluid::Advection::cubic},
                                                    {"maccormack", fluid::Advection::maccormack}}));
    app.add_option("--stepping", options.stepping)
        ->transform(CLI::CheckedTransformer(std::map<std::string, fluid::Stepping>{
            {"project", fluid::Stepping::project}, {"reflect", fluid::Stepping::reflect}}));
    app.add_option("--solver", options.solver)
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, fluid::Solver>{{"jacobi", fluid::Solver::jacobi},
                                                 {"multigrid", fluid::Solver::multigrid},
                                                 {"spectral", fluid::Solver::spectral}}));
    return bench::run(app, argc, argv, [&] { measure(options); });
}
