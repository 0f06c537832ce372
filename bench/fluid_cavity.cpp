// SPDX-License-Identifier: MIT
// The lid-driven cavity until it stands still, against Ghia, Ghia and Shin. estampe_bench_fluid_cavity --help

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/error.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/cavity.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/read_fields.hpp"

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
    gpu::Device device(RendererOptions{.device = options.device});
    gpu::Executor executor(device);
    const fluid::Grid grid = fluid::cavity_grid(options.side);
    fluid::Fluid cavity(device, grid);
    const fluid::FluidStyle style{.step_s = static_cast<float>(options.courant / options.side),
                                  .stepping = options.stepping,
                                  .velocity_advection = options.advection,
                                  .projection = {.solver = options.solver},
                                  .viscosity_m2_s = 1.0F / static_cast<float>(options.reynolds)};
    const auto steps = static_cast<uint32_t>(options.time_s * options.side / options.courant);
    const auto begin = std::chrono::steady_clock::now();
    constexpr uint32_t reports = 10;
    for (uint32_t i = 0, reported = 0; i < steps;) {
        gpu::Graph graph;
        const uint32_t count = std::min(steps - i, cavity.most_steps(style));
        const fluid::FluidFields fields = cavity.add_steps(graph, style, count);
        i += count;
        if (i * reports / steps == reported) {
            executor.run(graph);
            continue;
        }
        reported = i * reports / steps;
        const std::vector<float> velocity = fluid::run_and_read(device, executor, graph, fields.velocity);
        const fluid::CavityFit fit = fluid::cavity_fit(grid, velocity, options.reynolds);
        fmt::print("after {:6.2f} s: rms of u {:.4f}, of v {:.4f}; u from {:.4f}, v from {:.4f} to {:.4f}\n",
                   static_cast<double>(i) * static_cast<double>(style.step_s), fit.rms_u, fit.rms_v,
                   fit.least_u, fit.least_v, fit.most_v);
        static_cast<void>(std::fflush(stdout));
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    fmt::print("{}: {} steps of {:.3f} ms\n", device.info().name, steps, took.count() / steps);
}

} // namespace

int main(int count, char** arguments)
{
    Options options;
    CLI::App app("Lets the lid of a cavity drive what is in it, and compares with what is known");
    app.add_option("--device", options.device);
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
    CLI11_PARSE(app, count, arguments);
    try {
        measure(options);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
