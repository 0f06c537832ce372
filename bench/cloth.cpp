// SPDX-License-Identifier: MIT
// Measures the cost of a frame of cloth: a sixtieth of a second, from simulation steps to normals.
// estampe_bench_cloth --help

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/scene.glsl.h"
#include "techniques/cloth/cloth.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    uint32_t side = 32;
    uint32_t sheets = 50;
    uint32_t colliders = 0;
    uint32_t rounds = 40;
    float wind_m_per_s = 5.0F;
    float step_s = 1.0F / 120.0F;
    float effort = 1.0F;
    float before_s = 0.0F;
    bool verlet = false;
    bool descent = false;
    bool strain = false;
    bool restless = false;
    bool passes = false;
};

struct Hung {
    std::vector<cloth::Sheet> sheets;
    std::vector<cloth::DrawnSheet> drawn;
    uint32_t vertex_count = 0;
};

Hung hang_up(const Options& options)
{
    Hung hung;
    for (uint32_t i = 0; i < options.sheets; ++i) {
        const glm::vec3 corner(2.0F * static_cast<float>(i), 0.0F, 0.0F);
        cloth::Sheet sheet =
            cloth::grid_sheet(glm::uvec2(options.side), corner, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F});
        cloth::DrawnSheet drawn{.first_vertex = hung.vertex_count};
        for (uint32_t k = 0; k < sheet.rest_m.size(); ++k) {
            sheet.held.push_back(k % options.side == 0 ? 1.0F : 0.0F);
            drawn.particle_of_vertex.push_back(k);
        }
        hung.vertex_count += static_cast<uint32_t>(sheet.rest_m.size());
        hung.sheets.push_back(std::move(sheet));
        hung.drawn.push_back(std::move(drawn));
    }
    return hung;
}

std::vector<cloth::Solid> solids_of(const Options& options)
{
    std::vector<cloth::Solid> solids;
    for (uint32_t i = 0; i < options.colliders; ++i) {
        const glm::vec3 centre(0.15F + 0.23F * static_cast<float>(i % 4),
                               -0.15F - 0.23F * static_cast<float>(i / 4 % 4), 0.1F);
        cloth::Solid solid = cloth::ball(centre, 0.09F);
        solid.kind = std::array{cloth::SolidKind::ellipsoid, cloth::SolidKind::box,
                                cloth::SolidKind::cylinder, cloth::SolidKind::capsule}
                         .at(i % 4);
        solids.push_back(solid);
    }
    return solids;
}

void choose_solver(gpu::Device& device, cloth::Cloths& cloths, const Options& options)
{
    if (options.verlet || options.descent) {
        cloths.set_solver(device, options.verlet ? ClothSolver::verlet : ClothSolver::block_descent);
    }
}

/// Simulates `steps` steps, in as many graphs as needed. `finish` adds to the last graph. Returns the timings
/// of all passes.
template <class Finish>
std::vector<PassTiming> take_steps(bench::Machine& machine, cloth::Cloths& cloths,
                                   cloth::Surroundings& surroundings, uint32_t steps, const Finish& finish)
{
    std::vector<PassTiming> passes;
    bench::in_batches(steps, cloths.most_steps(surroundings), [&](uint32_t count, bool is_last) {
        gpu::Graph graph;
        cloth::Cloths::Handles handles = cloths.import(graph);
        cloths.add_steps(graph, handles, surroundings, count);
        surroundings.time_s += static_cast<double>(count) * static_cast<double>(surroundings.step_s);
        if (is_last) {
            finish(graph, handles);
        }
        machine.executor.run(graph);
        passes.insert(passes.end(), machine.passes().begin(), machine.passes().end());
    });
    return passes;
}

/// Measures the strain of a square metre of cloth that is held by two corners: how much longer or shorter its
/// edges are 5 s after it was released.
void measure_strain(const Options& options)
{
    bench::Machine machine(options.device);
    cloth::Sheet sheet =
        cloth::grid_sheet(glm::uvec2(options.side), {}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F});
    sheet.held.assign(sheet.rest_m.size(), 0.0F);
    sheet.held[0] = sheet.held[options.side - 1] = 1.0F;
    cloth::Cloths cloths(machine.device, {&sheet, 1});
    choose_solver(machine.device, cloths, options);
    cloth::Surroundings surroundings{.step_s = options.step_s, .effort = options.effort};
    gpu::Buffer places(machine.device, "places", cloths.state().front()->size_bytes(),
                       gpu::MemoryUse::readback);
    const bench::WallClock clock;
    take_steps(machine, cloths, surroundings, static_cast<uint32_t>(std::lround(5.0F / options.step_s)),
               [&](gpu::Graph& graph, const cloth::Cloths::Handles& handles) {
                   gpu::add_read_back(graph, "places", handles.places, places);
               });
    const double took_ms = clock.ms();
    const auto at = gpu::items_of<glm::vec4>(places);
    std::vector<double> strains;
    for (const glm::uvec3& triangle : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = triangle[k];
            const uint32_t b = triangle[(k + 1) % 3];
            strains.push_back(100.0 * std::abs(glm::distance(glm::vec3(at[a]), glm::vec3(at[b])) /
                                                   glm::distance(sheet.rest_m[a], sheet.rest_m[b]) -
                                               1.0F));
        }
    }
    std::ranges::sort(strains);
    fmt::print("{}: strain of {} x {} after 5 s: median {:.2f}, 99th percentile {:.2f}, most {:.2f} %; "
               "{:.2f} ms a frame by the wall\n",
               machine.name(), options.side, options.side, strains[strains.size() / 2],
               strains[strains.size() * 99 / 100], strains.back(), took_ms / 300.0);
}

void measure(const Options& options)
{
    bench::Machine machine(options.device);
    const Hung hung = hang_up(options);
    cloth::Cloths cloths(machine.device, hung.sheets, hung.drawn);
    choose_solver(machine.device, cloths, options);
    cloths.set_solids(machine.device, solids_of(options));
    gpu::Buffer posed(machine.device, "posed vertices", hung.vertex_count * sizeof(shared::PosedVertex),
                      gpu::MemoryUse::device);
    cloth::Surroundings surroundings{.step_s = options.step_s, .effort = options.effort};
    surroundings.wind.speed_m_per_s = options.wind_m_per_s;
    surroundings.rest_m_per_s = options.restless ? 0.0F : surroundings.rest_m_per_s;
    take_steps(machine, cloths, surroundings, static_cast<uint32_t>(options.before_s / options.step_s),
               [](gpu::Graph&, const cloth::Cloths::Handles&) {});
    const auto steps = static_cast<uint32_t>(std::max(1.0F, std::round(1.0F / 60.0F / options.step_s)));
    constexpr uint32_t compiling = 2; ///< number of first frames, in which shaders are compiled
    bench::Rounds by_passes;
    bench::Rounds by_wall;
    for (uint32_t round = 0; round < options.rounds + compiling; ++round) {
        const bench::WallClock clock;
        const std::vector<PassTiming> passes = take_steps(
            machine, cloths, surroundings, steps, [&](gpu::Graph& graph, cloth::Cloths::Handles& handles) {
                graph.export_buffer(
                    cloths.add_vertices(graph, handles, gpu::import_whole(graph, "posed", posed)));
            });
        if (round >= compiling) {
            by_wall.add(clock.ms());
            by_passes.add(bench::sum_ms(passes), passes);
        }
    }
    fmt::print("{}: {} sheets of {} x {}, {} colliders, {} steps a frame: {} by passes, {} by the wall\n{}",
               machine.name(), options.sheets, options.side, options.side, options.colliders, steps,
               by_passes.text(), by_wall.text(), options.passes ? by_passes.passes_table() : "");
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Measures what cloth costs", "estampe_bench_cloth");
    bench::add_device_option(app, options.device);
    app.add_option("--side", options.side, "Particles of a side")->check(CLI::Range(3, 2048));
    app.add_option("--sheets", options.sheets)->check(CLI::Range(1, 10000));
    app.add_option("--colliders", options.colliders)->check(CLI::Range(0, 1000));
    app.add_option("--rounds", options.rounds, "Frames to take the median of")->check(CLI::Range(1, 100000));
    app.add_option("--wind", options.wind_m_per_s, "Metres a second, with gusts and eddies");
    app.add_option("--step", options.step_s, "Seconds; a frame is a sixtieth")
        ->check(CLI::Range(1e-4, 1.0 / 30));
    app.add_option("--effort", options.effort)->check(CLI::Range(0.05, 8.0));
    app.add_option("--before", options.before_s, "Seconds that they have moved when frames begin");
    app.add_flag("--restless", options.restless, "None comes to rest");
    app.add_flag("--verlet", options.verlet, "The thesis's relaxation");
    app.add_flag("--descent", options.descent, "Vertex block descent");
    app.add_flag("--strain", options.strain, "Measures how far one sheet stretches instead");
    app.add_flag("--passes", options.passes, "Also prints what each pass costs");
    return bench::run(app, argc, argv, [&] {
        if (options.strain) {
            measure_strain(options);
        } else {
            measure(options);
        }
    });
}
