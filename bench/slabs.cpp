// SPDX-License-Identifier: MIT
// Measures the cost of a step of sand slabs, and draws the resulting dunes from above in a low sun.
// estampe_bench_slabs --help

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "gpu/transfers.hpp"
#include "style/schema.hpp"
#include "techniques/terrain/slabs/slabs.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    std::vector<std::string> settings;
    std::string picture;
    uint32_t side = 512;
    uint32_t steps = 2000;
    double sun_azimuth_deg = 200.0; ///< from the field's x towards its y
    double sun_elevation_deg = 20.0;
};

/// Heights in metres of a field that repeats at its edges.
struct Ground {
    uint32_t side = 0;
    double cell_m = 1.0;
    std::vector<float> heights_m;

    [[nodiscard]] double at(int x, int y) const
    {
        const auto wrapped = [&](int i) { return static_cast<uint32_t>(i) & (side - 1); };
        return static_cast<double>(heights_m[wrapped(y) * side + wrapped(x)]);
    }

    /// Interpolates linearly between cells.
    [[nodiscard]] double at(glm::dvec2 cell) const
    {
        const glm::ivec2 near(glm::floor(cell));
        const glm::dvec2 share = cell - glm::dvec2(near);
        return glm::mix(glm::mix(at(near.x, near.y), at(near.x + 1, near.y), share.x),
                        glm::mix(at(near.x, near.y + 1), at(near.x + 1, near.y + 1), share.x), share.y);
    }
};

uint8_t shade(const Ground& ground, glm::ivec2 p, glm::dvec3 sun)
{
    const double dx = (ground.at(p.x + 1, p.y) - ground.at(p.x - 1, p.y)) / (2.0 * ground.cell_m);
    const double dy = (ground.at(p.x, p.y + 1) - ground.at(p.x, p.y - 1)) / (2.0 * ground.cell_m);
    double light = std::max(glm::dot(glm::normalize(glm::dvec3(-dx, 1.0, -dy)), sun), 0.0);
    const glm::dvec2 sunwards = glm::normalize(glm::dvec2(sun.x, sun.z));
    const double rise_m = ground.cell_m * sun.y / std::hypot(sun.x, sun.z);
    for (int i = 1; i < 200 && light > 0.0; ++i) {
        if (ground.at(glm::dvec2(p) + static_cast<double>(i) * sunwards) > ground.at(p.x, p.y) + i * rise_m) {
            light = 0.0;
        }
    }
    return static_cast<uint8_t>(255.0 * std::pow(std::min(0.06 + 0.85 * light, 1.0), 1.0 / 2.2));
}

void save_picture(const Ground& ground, const Options& options)
{
    const double azimuth = glm::radians(options.sun_azimuth_deg);
    const double elevation = glm::radians(options.sun_elevation_deg);
    const glm::dvec3 sun(std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                         std::sin(azimuth) * std::cos(elevation));
    bench::save_gray_picture(
        ground.side, ground.side,
        [&](uint32_t x, uint32_t y) { return shade(ground, glm::ivec2(x, y), sun); }, options.picture);
}

/// Share of the cells that are steeper than the angle of repose, and share of the cells between 30 and 34
/// degrees.
void tell_slopes(const Ground& ground)
{
    std::vector<uint32_t> cells_at_deg(91);
    for (uint32_t i = 0; i < ground.side * ground.side; ++i) {
        const glm::ivec2 p(i % ground.side, i / ground.side);
        const double dx = (ground.at(p.x + 1, p.y) - ground.at(p.x - 1, p.y)) / (2.0 * ground.cell_m);
        const double dy = (ground.at(p.x, p.y + 1) - ground.at(p.x, p.y - 1)) / (2.0 * ground.cell_m);
        ++cells_at_deg[static_cast<size_t>(glm::degrees(std::atan(std::hypot(dx, dy))))];
    }
    fmt::print("cells in a thousand by whole degrees of slope:");
    for (size_t deg = 0; deg < 45; ++deg) {
        fmt::print(" {}", 1000 * cells_at_deg[deg] / (ground.side * ground.side));
    }
    fmt::print("\n");
}

void measure(const Options& options)
{
    terrain::SlabStyle style;
    const style::Schema schema(terrain::slab_table());
    for (const std::string& setting : options.settings) {
        schema.set(style, setting);
    }
    bench::Machine machine(options.device);
    terrain::SlabField field(machine.device, style, options.side);
    const uint64_t size_bytes = sizeof(float) * uint64_t{options.side} * options.side;
    gpu::Buffer read_back(machine.device, "heights", size_bytes, gpu::MemoryUse::readback);
    const bench::WallClock clock;
    bench::in_batches(options.steps, terrain::SlabField::most_steps(style),
                      [&](uint32_t count, bool is_last) {
                          gpu::Graph graph;
                          const gpu::ImageId height = field.add_steps(graph, style, count);
                          if (is_last) {
                              gpu::add_read_back(graph, "read back", height, read_back);
                          }
                          machine.executor.run(graph);
                      });
    fmt::print("{}: {} steps of {} x {} cells on {}: {:.4f} ms a step\n", machine.name(), options.steps,
               options.side, options.side, machine.device.info().driver, clock.ms() / options.steps);
    const auto heights = gpu::items_of<float>(read_back);
    const Ground ground{.side = options.side,
                        .cell_m = static_cast<double>(style.cell_m),
                        .heights_m = {heights.begin(), heights.end()}};
    tell_slopes(ground);
    if (!options.picture.empty()) {
        save_picture(ground, options);
    }
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Measures what a step of slabs costs", "estampe_bench_slabs");
    app.add_option("--side", options.side, "Cells of a side, a power of two")->capture_default_str();
    app.add_option("--steps", options.steps)->capture_default_str()->check(CLI::Range(1, 10000000));
    bench::add_set_option(app, options.settings);
    bench::add_device_option(app, options.device);
    app.add_option("--picture", options.picture, "PNG file to write");
    app.add_option("--sun-azimuth-deg", options.sun_azimuth_deg)->capture_default_str();
    app.add_option("--sun-elevation-deg", options.sun_elevation_deg)->capture_default_str();
    return bench::run(app, argc, argv, [&] { measure(options); });
}
