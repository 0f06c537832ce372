// SPDX-License-Identifier: MIT
// Smoke that rises past a ball and an oar that turns, as a picture. estampe_bench_fluid_smoke --help

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/read_fields.hpp"

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
    gpu::Device device(RendererOptions{.device = options.device});
    gpu::Executor executor(device);
    const fluid::Grid grid{.cells = {options.width, options.width * 3 / 2, 1},
                           .cell_m = 2.0F / static_cast<float>(options.width)};
    fluid::Fluid smoke(device, grid, 2);
    smoke.set_shapes(obstacles(), std::vector{fire()});
    const fluid::FluidStyle style{.step_s = 1.0F / 60.0F,
                                  .forces = {.lift_m_s2 = 1.5F},
                                  .matter = {.fading_per_s = 0.05F, .cooling_per_s = 0.15F}};
    const auto steps = static_cast<uint32_t>(options.time_s / static_cast<double>(style.step_s));
    for (uint32_t i = 0; i < steps;) {
        const uint32_t count = std::min(steps - i, smoke.most_steps(style));
        gpu::Graph graph;
        static_cast<void>(smoke.add_steps(graph, style, count));
        executor.run(graph);
        i += count;
    }
    gpu::Graph graph;
    const fluid::FluidFields fields = smoke.add_steps(graph, style, 0);
    const std::vector<float> density = fluid::run_and_read(device, executor, graph, *fields.quantities);
    Image image{.width = grid.cells.x, .height = grid.cells.y};
    for (uint32_t i = 0; i < grid.cells.x * grid.cells.y; ++i) {
        const uint32_t row = grid.cells.y - 1 - i / grid.cells.x; // y is up
        const uint32_t cell = row * grid.cells.x + i % grid.cells.x;
        const uint8_t gray = gray_of(density[cell]);
        image.rgba.insert(image.rgba.end(), {gray, gray, gray, 255});
    }
    save_png(image, options.picture);
}

} // namespace

int main(int count, char** arguments)
{
    Options options;
    CLI::App app("Draws smoke that rises past obstacles");
    app.add_option("--device", options.device);
    app.add_option("--picture", options.picture, "PNG file to write");
    app.add_option("--width", options.width, "Cells; half as many more along y")->check(CLI::Range(16, 2048));
    app.add_option("--time-s", options.time_s)->check(CLI::Range(0.0, 600.0));
    CLI11_PARSE(app, count, arguments);
    try {
        draw(options);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
