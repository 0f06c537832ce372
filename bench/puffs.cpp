// SPDX-License-Identifier: MIT
// Lets a warm puff rise in a closed room by each way to keep air from piling up: the time of a step, the
// divergence left, the smoke that is gained or lost, and a picture of all puffs side by side.
// estampe_bench_puffs --help

#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "fluid_measures.hpp"
#include "techniques/fluid/fluid.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    std::string picture = "puffs.png";
    uint32_t width = 128;
    double time_s = 2.5;
};

/// A warm puff near the floor of a closed room, 1 m wide and 2 m high.
std::vector<float> puff(const fluid::Grid& grid)
{
    std::vector<float> quantities;
    for (int channel = 0; channel < 2; ++channel) {
        for (uint32_t y = 0; y < grid.cells.y; ++y) {
            for (uint32_t x = 0; x < grid.cells.x; ++x) {
                const glm::vec2 place = (glm::vec2(x, y) + 0.5F) * grid.cell_m;
                quantities.push_back(glm::distance(place, {0.48F, 0.35F}) < 0.2F ? 1.0F : 0.0F);
            }
        }
    }
    return quantities;
}

struct Result {
    std::vector<float> density;
    double step_ms = 0.0;    ///< median
    double divergence = 0.0; ///< root mean square of the outflow of cells over that of the speeds
    double gained = 0.0;     ///< share of the density
};

Result risen_puff(bench::Machine& machine, const fluid::Grid& grid, const fluid::FluidStyle& style,
                  double time_s)
{
    const std::vector<float> start = puff(grid);
    fluid::Fluid air(machine.device, grid, 2, {}, start);
    static_cast<void>(air.check_spectral(machine.device, machine.executor));
    air.ensure_mass(machine.device, style);
    const auto steps = static_cast<uint32_t>(time_s / static_cast<double>(style.step_s));
    bench::Rounds rounds;
    for (uint32_t i = 0; i < steps; ++i) {
        gpu::Graph graph;
        static_cast<void>(air.add_steps(graph, style, 1));
        rounds.add(machine.run(graph));
    }
    const auto read = [&](bool is_density) {
        gpu::Graph graph;
        const fluid::FluidFields fields = air.add_steps(graph, style, 0);
        return fluid::run_and_read(machine.device, machine.executor, graph,
                                   is_density ? *fields.quantities : fields.velocity);
    };
    Result result{.density = read(true), .step_ms = median_of(rounds.times_ms())};
    gpu::Graph graph;
    const fluid::FluidFields fields = air.add_steps(graph, style, 0);
    // Each speed belongs to two cells: a cell's outflow is the sum of four speeds.
    result.divergence =
        bench::divergence_of(machine, grid, graph, fields.velocity, fields.solids) / bench::norm(read(false));
    const auto sum = [&](std::span<const float> numbers) {
        double all = 0.0;
        for (const float number : numbers.first(grid.cell_count())) {
            all += static_cast<double>(number);
        }
        return all;
    };
    result.gained = sum(result.density) / sum(start) - 1.0;
    return result;
}

void compare_puffs(const Options& options)
{
    constexpr fluid::Advection linear = fluid::Advection::linear;
    constexpr fluid::Advection automatic = fluid::Advection::automatic;

    struct Way {
        const char* name;
        fluid::Solver solver;
        fluid::Advection advection;
    };

    const std::array<Way, 4> ways{
        {{"direct or multigrid, cubic advection", fluid::Solver::automatic, automatic},
         {"80 rounds of Jacobi, cubic advection", fluid::Solver::jacobi, automatic},
         {"80 rounds of Jacobi, linear advection", fluid::Solver::jacobi, linear},
         {"mass, advection both ways", fluid::Solver::mass, linear}}};
    bench::Machine machine(options.device);
    const uint32_t width = options.width;
    const fluid::Grid grid{.cells = {width, 2 * width, 1}, .cell_m = 1.0F / static_cast<float>(width)};
    fmt::print("{}, {}\n{} x {} cells, {} s in steps of 1/60 s\n"
               "| solver | step, ms | divergence, per speed | density gained |\n|---|---|---|---|\n",
               machine.name(), machine.device.info().driver, grid.cells.x, grid.cells.y, options.time_s);
    std::vector<std::vector<float>> densities;
    for (const Way& way : ways) {
        const fluid::FluidStyle style{.step_s = 1.0F / 60.0F,
                                      .stepping = fluid::Stepping::project,
                                      .velocity_advection = way.advection,
                                      .quantity_advection = way.advection,
                                      .projection = {.solver = way.solver},
                                      .forces = {.lift_m_s2 = 1.5F}};
        Result result = risen_puff(machine, grid, style, options.time_s);
        fmt::print("| {} | {:.3f} | {:.1e} | {:+.3f} % |\n", way.name, result.step_ms, result.divergence,
                   100.0 * result.gained);
        static_cast<void>(std::fflush(stdout));
        densities.push_back(std::move(result.density));
    }
    bench::save_gray_picture(
        static_cast<uint32_t>(ways.size()) * grid.cells.x, grid.cells.y,
        [&](uint32_t x, uint32_t y) {
            const uint32_t row = grid.cells.y - 1 - y; // the grid's y points up
            return x % grid.cells.x == 0
                       ? uint8_t{0}
                       : bench::gray_of(densities[x / grid.cells.x][row * grid.cells.x + x % grid.cells.x]);
        },
        options.picture);
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Compares the solvers of a fluid on a warm puff in a closed room", "estampe_bench_puffs");
    bench::add_device_option(app, options.device);
    app.add_option("--picture", options.picture, "PNG file to write")->capture_default_str();
    app.add_option("--width", options.width, "Cells along x; twice as many along y")
        ->capture_default_str()
        ->check(CLI::Range(16, 1024));
    app.add_option("--time-s", options.time_s)->capture_default_str()->check(CLI::Range(0.1, 600.0));
    return bench::run(app, argc, argv, [&] { compare_puffs(options); });
}
