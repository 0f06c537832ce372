// SPDX-License-Identifier: MIT
// Measures the cost and the accuracy of fluids: the time of a step, pass by pass; the time that each solver
// needs to reach a given divergence; the lid-driven cavity compared with Ghia, Ghia and Shin; smoke as a
// picture.
// estampe_bench_fluid --help

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "fluid_measures.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "techniques/fluid/cavity.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/pressure/projection.hpp"
#include "techniques/fluid/pressure/solvers.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

/// Options of the commands "steps" and "solvers".
struct CostOptions {
    std::string device = "auto";
    std::vector<uint32_t> sizes{256, 512, 1024, 2048, 4096};
    uint32_t depth = 1;
    bool periodic = false;
    uint32_t rounds = 40;            ///< only for "steps"
    uint32_t most_projections = 100; ///< only for "solvers"
};

fluid::Grid grid_of(const CostOptions& options, uint32_t side)
{
    const fluid::Edge edge = options.periodic ? fluid::Edge::periodic : fluid::Edge::no_slip;
    return {.cells = {side, side, options.depth},
            .cell_m = 1.0F / static_cast<float>(side),
            .edges = {edge, edge, edge}};
}

std::vector<float> over_faces(const fluid::Grid& grid, const std::function<glm::dvec3(glm::dvec3)>& flow)
{
    std::vector<float> numbers;
    for (uint32_t i = 0; i < grid.dimensions(); ++i) {
        for (uint64_t k = 0; k < grid.cell_count(); ++k) {
            const auto n = static_cast<uint32_t>(k);
            const glm::uvec3 cell(n % grid.cells.x, n / grid.cells.x % grid.cells.y,
                                  n / (grid.cells.x * grid.cells.y));
            const auto axis = static_cast<int>(i);
            const bool is_on_wall = !grid.is_periodic(i) && cell[axis] == 0;
            glm::dvec3 place = (glm::dvec3(cell) + 0.5) / static_cast<double>(grid.cells.x);
            place[axis] -= 0.5 / static_cast<double>(grid.cells.x);
            numbers.push_back(is_on_wall ? 0.0F : static_cast<float>(flow(place)[axis]));
        }
    }
    return numbers;
}

/// A gust as wide as 8 % of the grid, so that all of its divergence has a large scale.
glm::dvec3 gust(glm::dvec3 place)
{
    const glm::dvec2 off = (glm::dvec2(place) - 0.5) / 0.08;
    return {std::exp(-glm::dot(off, off)), 0.0, 0.0};
}

struct Case {
    std::string name;
    fluid::FluidStyle style;
    std::vector<fluid::Shape> obstacles;
};

std::vector<Case> cases()
{
    using fluid::Advection;
    const auto style = [](fluid::Solver solver, fluid::Stepping stepping, Advection advection) {
        return fluid::FluidStyle{.step_s = 1.0F / 240.0F,
                                 .stepping = stepping,
                                 .velocity_advection = advection,
                                 .quantity_advection = advection,
                                 .projection = {.solver = solver}};
    };
    fluid::Shape ball = fluid::disc({0.3F, 0.4F, 0.3F}, 0.1F);
    ball.velocity_m_per_s = {0.5F, 0.2F, 0.0F};
    fluid::Shape oar = fluid::box({0.7F, 0.6F, 0.5F}, {0.15F, 0.02F, 0.1F}, 0.4F);
    oar.spin_rad_s = 3.0F;
    fluid::FluidStyle expanding =
        style(fluid::Solver::automatic, fluid::Stepping::reflect, Advection::automatic);
    expanding.matter.expands_above = 1.0F;
    expanding.matter.expansion_per_s = 10.0F;
    return {{"automatic, reflected: the default",
             style(fluid::Solver::automatic, fluid::Stepping::reflect, Advection::automatic),
             {}},
            {"the same with splines",
             style(fluid::Solver::automatic, fluid::Stepping::reflect, Advection::cubic),
             {}},
            {"the same with MacCormack's scheme",
             style(fluid::Solver::automatic, fluid::Stepping::reflect, Advection::maccormack),
             {}},
            {"the default with two moving obstacles",
             style(fluid::Solver::automatic, fluid::Stepping::reflect, Advection::automatic),
             {ball, oar}},
            {"the default, where hot fluid may expand", expanding, {}},
            {"the default by multigrid, without obstacles",
             style(fluid::Solver::multigrid, fluid::Stepping::reflect, Advection::automatic),
             {}},
            {"projected plainly",
             style(fluid::Solver::automatic, fluid::Stepping::project, Advection::automatic),
             {}},
            {"projected plainly by 80 rounds of Jacobi, linear",
             style(fluid::Solver::jacobi, fluid::Stepping::project, Advection::linear),
             {}}};
}

/// Ratio of the divergence after the next step's last projection to the divergence before the projection.
double divergence_left(bench::Machine& machine, fluid::Fluid& flow, const fluid::FluidStyle& style)
{
    gpu::Graph before;
    const fluid::FluidFields given = flow.add_steps(before, style, 1);
    const double all = bench::divergence_of(machine, flow.grid(), before, given.unprojected, given.solids);
    gpu::Graph after;
    const fluid::FluidFields left = flow.add_steps(after, style, 0);
    return bench::divergence_of(machine, flow.grid(), after, left.velocity, left.solids) / all;
}

void measure_steps(bench::Machine& machine, const CostOptions& options, uint32_t side)
{
    constexpr uint32_t channels = 4;
    const fluid::Grid grid = grid_of(options, side);
    for (const Case& one : cases()) {
        fluid::Fluid flow(machine.device, grid, channels, over_faces(grid, gust));
        flow.set_shapes(one.obstacles, {});
        const double residual = flow.check_spectral(machine.device, machine.executor);
        bench::Rounds rounds;
        for (uint32_t i = 0; i < options.rounds; ++i) {
            gpu::Graph graph;
            static_cast<void>(flow.add_steps(graph, one.style, 1));
            const double ms = machine.run(graph);
            rounds.add(ms, machine.passes());
        }
        const size_t passes = machine.passes().size();
        fmt::print(
            "{0} x {0}{1}, {2}: {3}, {4} passes, divergence left {5:.1e}, residual of the direct solver "
            "at the start {6:.1e}\n{7}",
            side, grid.is_volume() ? fmt::format(" x {}", options.depth) : "", one.name, rounds.text(),
            passes, divergence_left(machine, flow, one.style), residual, rounds.passes_table());
        static_cast<void>(std::fflush(stdout));
    }
}

void add_cost_options(CLI::App& command, CostOptions& options)
{
    bench::add_device_option(command, options.device);
    command.add_option("--sizes", options.sizes, "Cells of a side, one or several");
    command.add_option("--depth", options.depth, "Cells along z; 1 for two dimensions");
    command.add_flag("--periodic", options.periodic, "Edges that meet in place of walls");
}

bench::Job add_steps(CLI::App& command)
{
    const auto options = std::make_shared<CostOptions>();
    add_cost_options(command, *options);
    command.add_option("--rounds", options->rounds, "Steps to take the median of")
        ->check(CLI::Range(1, 100000));
    return [options] {
        bench::Machine machine(options->device);
        fmt::print("{}, {}\n", machine.name(), machine.device.info().driver);
        for (const uint32_t side : options->sizes) {
            measure_steps(machine, *options, side);
        }
    };
}

/// A velocity field that is projected repeatedly.
class Projecting {
public:
    Projecting(bench::Machine& machine, const fluid::Grid& grid, const std::vector<float>& start)
        : machine_(machine), grid_(grid),
          cells_(gpu::upload_buffer(machine.device, "solids", std::vector<uint32_t>(grid.cell_count()))),
          angles_(fluid::upload_angles(machine.device, grid))
    {
        for (gpu::Image& image : images_) {
            image = gpu::Image(machine.device, "velocity", fluid::velocity_desc(grid));
            const size_t layer_size = size_t{grid.cells.x} * grid.cells.y;
            gpu::upload_layers(machine.device, image, [&](uint32_t layer) {
                const auto bytes = std::as_bytes(std::span(start).subspan(layer * layer_size, layer_size));
                return gpu::LayerPixels{.levels = {{bytes.begin(), bytes.end()}}};
            });
        }
    }

    /// Projects once. Returns milliseconds.
    double project(const fluid::ProjectionStyle& style)
    {
        gpu::Graph graph;
        const fluid::Solids solids{.cells = gpu::import_whole(graph, "solids", cells_)};
        const gpu::ImageId from = gpu::import_uploaded(graph, "from", images_[newest_]);
        newest_ = 1 - newest_;
        const fluid::Projected projected =
            fluid::add_projection(graph, grid_, style,
                                  {.velocity = from,
                                   .tables = {.solids = solids,
                                              .weights = fluid::add_weights(graph, grid_, solids),
                                              .angles = gpu::import_whole(graph, "angles", angles_)},
                                   .target = gpu::import_uploaded(graph, "to", images_[newest_])},
                                  false);
        fluid::hand_on(graph, from);
        fluid::hand_on(graph, projected.velocity);
        return machine_.run(graph);
    }

    double divergence()
    {
        gpu::Graph graph;
        const fluid::Solids solids{.cells = gpu::import_whole(graph, "solids", cells_)};
        return bench::divergence_of(machine_, grid_, graph,
                                    gpu::import_uploaded(graph, "velocity", images_[newest_]), solids);
    }

private:
    bench::Machine& machine_;
    fluid::Grid grid_;
    std::array<gpu::Image, 2> images_;
    uint32_t newest_ = 0;
    gpu::Buffer cells_;
    gpu::Buffer angles_;
};

void measure_solver(bench::Machine& machine, const CostOptions& options, const fluid::Grid& grid,
                    fluid::Solver solver, const std::vector<float>& start)
{
    constexpr std::array<double, 5> goals{1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
    const fluid::ProjectionStyle style{.solver = solver, .projections = 1};
    Projecting(machine, grid, start).project(style); // the first run compiles the shaders
    Projecting projecting(machine, grid, start);
    const double all = projecting.divergence();
    double spent_ms = 0.0;
    size_t goal = 0;
    double left = 1.0;
    bench::Rounds rounds;
    std::string reached;
    for (uint32_t i = 1; i <= options.most_projections && goal < goals.size(); ++i) {
        rounds.add(projecting.project(style));
        spent_ms += rounds.times_ms().back();
        left = projecting.divergence() / all;
        for (; goal < goals.size() && left <= goals[goal]; ++goal) {
            reached += fmt::format(" | {:.3f} ({})", spent_ms, i);
        }
    }
    for (; goal < goals.size(); ++goal) {
        reached += fmt::format(" | no: {:.1e}", left);
    }
    fmt::print("{:.4f}{} |\n", median_of(rounds.times_ms()), reached);
    static_cast<void>(std::fflush(stdout));
}

void measure_solvers(bench::Machine& machine, const CostOptions& options, uint32_t side)
{
    const fluid::Grid grid = grid_of(options, side);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto noise = [&](glm::dvec3) { return glm::dvec3(any(random), any(random), any(random)); };
    const std::map<std::string, std::vector<float>> starts{{"noise", over_faces(grid, noise)},
                                                           {"gust", over_faces(grid, gust)}};
    const std::map<std::string, fluid::Solver> solvers{{"80 Jacobi", fluid::Solver::jacobi},
                                                       {"V(2,2)", fluid::Solver::multigrid},
                                                       {"spectral", fluid::Solver::spectral}};
    for (const auto& [field, start] : starts) {
        for (const auto& [name, solver] : solvers) {
            if (solver != fluid::Solver::spectral || fluid::is_spectral_possible(grid)) {
                fmt::print("| {} | {} | {} | ", side, field, name);
                measure_solver(machine, options, grid, solver, start);
            }
        }
    }
}

bench::Job add_solvers(CLI::App& command)
{
    const auto options = std::make_shared<CostOptions>();
    add_cost_options(command, *options);
    command
        .add_option("--most-projections", options->most_projections,
                    "Most projections before a solver is given up")
        ->check(CLI::PositiveNumber);
    return [options] {
        bench::Machine machine(options->device);
        fmt::print("{}, {}\nMilliseconds (and projections) until so much of the divergence is left, each "
                   "projection from anew:\n"
                   "| cells | field | solver | one projection | 0.1 | 0.01 | 1e-3 | 1e-4 | 1e-5 |\n"
                   "|---|---|---|---|---|---|---|---|---|\n",
                   machine.name(), machine.device.info().driver);
        for (const uint32_t side : options->sizes) {
            measure_solvers(machine, *options, side);
        }
    };
}

struct CavityOptions {
    std::string device = "auto";
    int reynolds = 1000;
    uint32_t side = 128;
    double time_s = 50.0;
    double courant = 0.5;
    fluid::Advection advection = fluid::Advection::maccormack;
    fluid::Stepping stepping = fluid::Stepping::reflect;
    fluid::Solver solver = fluid::Solver::automatic;
};

void measure_cavity(const CavityOptions& options)
{
    bench::Machine machine(options.device);
    const fluid::Grid grid = fluid::cavity_grid(options.side);
    fluid::Fluid cavity(machine.device, grid);
    const fluid::FluidStyle style{.step_s = static_cast<float>(options.courant / options.side),
                                  .stepping = options.stepping,
                                  .velocity_advection = options.advection,
                                  .projection = {.solver = options.solver},
                                  .viscosity_m2_s = 1.0F / static_cast<float>(options.reynolds)};
    cavity.ensure_mass(machine.device, style);
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

bench::Job add_cavity(CLI::App& command)
{
    const auto options = std::make_shared<CavityOptions>();
    bench::add_device_option(command, options->device);
    command.add_option("--reynolds", options->reynolds)->check(CLI::IsMember({100, 400, 1000}));
    command.add_option("--side", options->side, "Cells");
    command.add_option("--time-s", options->time_s);
    command.add_option("--courant", options->courant, "Cells that the lid goes in a step");
    command.add_option("--advection", options->advection)
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, fluid::Advection>{{"linear", fluid::Advection::linear},
                                                    {"cubic", fluid::Advection::cubic},
                                                    {"maccormack", fluid::Advection::maccormack}}));
    command.add_option("--stepping", options->stepping)
        ->transform(CLI::CheckedTransformer(std::map<std::string, fluid::Stepping>{
            {"project", fluid::Stepping::project}, {"reflect", fluid::Stepping::reflect}}));
    command.add_option("--solver", options->solver)
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, fluid::Solver>{{"jacobi", fluid::Solver::jacobi},
                                                 {"multigrid", fluid::Solver::multigrid},
                                                 {"spectral", fluid::Solver::spectral},
                                                 {"mass", fluid::Solver::mass}}));
    return [options] { measure_cavity(*options); };
}

struct SmokeOptions {
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

void draw_smoke(const SmokeOptions& options)
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
            const uint32_t row = grid.cells.y - 1 - y; // the grid's y points up
            return bench::gray_of(density[row * grid.cells.x + x]);
        },
        options.picture);
}

bench::Job add_smoke(CLI::App& command)
{
    const auto options = std::make_shared<SmokeOptions>();
    bench::add_device_option(command, options->device);
    command.add_option("--picture", options->picture, "PNG file to write")->capture_default_str();
    command.add_option("--width", options->width, "Cells; half as many more along y")
        ->capture_default_str()
        ->check(CLI::Range(16, 2048));
    command.add_option("--time-s", options->time_s)->capture_default_str()->check(CLI::Range(0.0, 600.0));
    return [options] { draw_smoke(*options); };
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures fluids", "estampe_bench_fluid");
    app.require_subcommand(1);
    bench::Job job;
    bench::add_command(app, "steps", "Time a step, pass by pass", add_steps, job);
    bench::add_command(app, "solvers", "Time each pressure solver to a given divergence", add_solvers, job);
    bench::add_command(app, "cavity",
                       "Let a lid drive the fluid in a cavity, and compare with the literature", add_cavity,
                       job);
    bench::add_command(app, "smoke", "Draw smoke that rises past obstacles", add_smoke, job);
    return bench::run(app, argc, argv, [&] { job(); });
}
