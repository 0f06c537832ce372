// SPDX-License-Identifier: MIT
// Smoke that rises past a ball and an oar that turns, as a picture. estampe_bench_fluid_smoke --help

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "techniques/fluid/fluid.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    std::string picture = "smoke.png";
    uint32_t width = 256;
    double time_s = 6.0;
};

/// Three metres high, two wide, from the floor's left end.
std::vector<fluid::Shape> obstacles()
{
    fluid::Shape oar = fluid::box({1.3F, 2.1F, 0.0F}, {0.28F, 0.03F, 0.0F}, 0.3F);
    oar.spin_rad_s = 1.5F;
    return {fluid::disc({0.9F, 1.2F, 0.0F}, 0.2F), oar};
}

fluid::Source fire()
{
    fluid::Source source{.shape = fluid::disc({1.0F, 0.25F, 0.0F}, 0.12F)};
    source.gain_per_s = {2.0F, 6.0F};
    return source;
}

uint8_t gray_of(float density)
{
    const double light = std::exp(-2.0 * std::max(static_cast<double>(density), 0.0));
    return static_cast<uint8_t>(std::lround(255.0 * std::pow(light, 1.0 / 2.2)));
}

void draw(const Options& options)
{
    bench::Machine machine(options.device);
    const fluid::Grid grid{.cells = {options.width, options.width * 3 / 2, 1},
                           .cell_m = 2.0F / static_cast<float>(options.width)};
    fluid::Fluid smoke(machine.device, grid, 2);
    smoke.set_shapes(obstacles(), std::vector{fire()});
    const fluid::FluidStyle style{.step_s = 1.0F / 60.0F,
                                  .forces = {.lift_m_s2 = 1.5F},
                                  .matter = {.fading_per_s = 0.05F, .cooling_per_s = 0.15F}};
    const auto steps = static_cast<uint32_t>(options.time_s / static_cast<double>(style.step_s));
    bench::in_batches(steps, smoke.most_steps(style), [&](uint32_t count, bool /*is_last*/) {
        gpu::Graph graph;
        static_cast<void>(smoke.add_steps(graph, style, count));
        machine.executor.run(graph);
    });
    gpu::Graph graph;
    const fluid::FluidFields fields = smoke.add_steps(graph, style, 0);
    const std::vector<float> density =
        fluid::run_and_read(machine.device, machine.executor, graph, *fields.quantities);
    bench::save_gray_picture(
        grid.cells.x, grid.cells.y,
        [&](uint32_t x, uint32_t y) {
            const uint32_t row = grid.cells.y - 1 - y; // y of the grid is up
            return gray_of(density[row * grid.cells.x + x]);
        },
        options.picture);
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Draws smoke that rises past obstacles", "estampe_bench_fluid_smoke");
    bench::add_device_option(app, options.device);
    app.add_option("--picture", options.picture, "PNG file to write")->capture_default_str();
    app.add_option("--width", options.width, "Cells; half as many more along y")
        ->capture_default_str()
        ->check(CLI::Range(16, 2048));
    app.add_option("--time-s", options.time_s)->capture_default_str()->check(CLI::Range(0.0, 600.0));
    return bench::run(app, argc, argv, [&] { draw(options); });
}
