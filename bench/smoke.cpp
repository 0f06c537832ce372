// SPDX-License-Identifier: MIT
// Measures the cost of smoke, pass by pass: a step of its fluid simulation, its shape and lighting, and its
// drawing on a page that the smoke fills. estampe_bench_smoke --help

#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/smoke/smoke.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    std::string device = "auto";
    uint32_t cells = 128;
    glm::uvec2 size_px{1920, 1080};
    uint32_t steps = 120;
    uint32_t rounds = 40;
    std::string sampling = "rays";
    bool puffs = true;
};

/// Runs graphs of one kind, and prints their times.
class Measured {
public:
    explicit Measured(bench::Machine& machine) : machine_(machine) {}

    void run(const gpu::Graph& graph)
    {
        const double ms = machine_.run(graph);
        rounds_.add(ms, machine_.passes());
    }

    void print(const char* what) const
    {
        fmt::print("{}: {}\n{}", what, rounds_.text(), rounds_.passes_table());
    }

private:
    bench::Machine& machine_;
    bench::Rounds rounds_;
};

/// A smoke box with sides of two metres, centred at the origin.
smoke::Box box_of(uint32_t cells)
{
    glm::dmat4 anchor_from_grid = glm::dmat4(2.0 / cells);
    anchor_from_grid[3] = glm::dvec4(-1.0, -1.0, -1.0, 1.0);
    return {.cells = glm::uvec3(cells),
            .cell_m = 2.0F / static_cast<float>(cells),
            .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_grid))};
}

fluid::FluidStyle solving()
{
    const fluid::Rim rim{.breadth_m = 0.3F, .share_per_s = 8.0F};
    return {.step_s = 1.0F / 24.0F,
            .stepping = fluid::Stepping::project,
            .forces = {.lift_m_s2 = 2.0F, .confinement_per_s = 1.0F, .rim = rim},
            .matter = {.fading_per_s = 0.25F, .cooling_per_s = 0.5F, .rim = rim}};
}

void measure(const Options& options)
{
    bench::Machine machine(options.device);
    const smoke::Box box = box_of(options.cells);
    const fluid::Edge open = fluid::Edge::periodic;
    fluid::Fluid fluid(machine.device,
                       {.cells = box.cells, .cell_m = box.cell_m, .edges = {open, open, open}}, 2);
    fluid::Source source{.shape = fluid::disc({1.0F, 0.4F, 1.0F}, 0.3F)};
    source.gain_per_s = {6.0F, 2.0F};
    fluid.set_shapes({}, std::vector{source});
    Measured steps(machine);
    for (uint32_t i = 0; i < options.steps; ++i) {
        gpu::Graph graph;
        static_cast<void>(fluid.add_steps(graph, solving(), 1));
        steps.run(graph);
    }
    fmt::print("{0} x {0} x {0} cells, {1} x {2} pixels, {3}\n", options.cells, options.size_px.x,
               options.size_px.y, machine.name());
    steps.print("a step");

    smoke::SmokeStyle style{.enabled = true};
    style.puffs = options.puffs;
    style.sampling = options.sampling == "axis"   ? smoke::Sampling::axis
                     : options.sampling == "view" ? smoke::Sampling::view
                                                  : smoke::Sampling::rays;
    const std::vector<smoke::Lamp> sun{{.place = {0.5F, 0.7F, 0.4F}, .luminance = 1.0F}};
    const shared::SmokeGlobals around = smoke::globals_of(std::span(&box, 1), style, {.lamps = sun});
    auto globals = gpu::upload_buffer(machine.device, "smoke", std::vector{around});
    // The box is as high as the page.
    const Camera camera{.eye = {0.6, 0.3, 4.4}, .target = {0.0, 0.0, 0.0}};
    auto frame = gpu::upload_buffer(
        machine.device, "frame",
        std::vector{features::frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = options.size_px})});
    smoke::VolumeMemory memory;
    memory.ensure(machine.device, around);
    gpu::Buffer pixels(machine.device, "pixels", uint64_t{4} * options.size_px.x * options.size_px.y,
                       gpu::MemoryUse::readback);
    Measured shaping(machine);
    for (uint32_t i = 0; i < options.rounds; ++i) {
        gpu::Graph graph;
        const fluid::FluidFields fields = fluid.add_steps(graph, solving(), 0);
        smoke::add_volume(
            graph, memory, style,
            {.globals = gpu::import_whole(graph, "smoke", globals), .densities = {*fields.quantities}});
        shaping.run(graph);
    }
    shaping.print("shape and light");
    Measured drawing(machine);
    for (uint32_t i = 0; i < options.rounds; ++i) {
        gpu::Graph graph;
        const gpu::ImageDesc page{.width = options.size_px.x, .height = options.size_px.y};
        gpu::ImageDesc depths = page;
        depths.format = gpu::Format::r32f;
        const smoke::ViewInputs view{.frame = gpu::import_whole(graph, "frame", frame),
                                     .globals = gpu::import_whole(graph, "smoke", globals),
                                     .depth = gpu::add_filled_image(graph, "depth", depths, glm::vec4(0.0F)),
                                     .size_px = options.size_px};
        const gpu::ImageId marched = smoke::add_march(graph, memory.import(graph), style, view);
        const smoke::Layer layer =
            smoke::add_ink(graph, style,
                           {.view = view,
                            .marched = marched,
                            .lines = gpu::add_filled_image(graph, "lines", page, glm::vec4(0.0F)),
                            .pixels_per_mm = static_cast<float>(options.size_px.y) / 150.0F});
        gpu::add_read_back(graph, "read back", layer.paint, pixels);
        drawing.run(graph);
    }
    drawing.print("drawing, and reading it back");
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Measures what smoke costs", "estampe_bench_smoke");
    bench::add_device_option(app, options.device);
    app.add_option("--cells", options.cells, "Along each side of the box, a power of two")
        ->check(CLI::Range(16, 256));
    app.add_option("--width", options.size_px.x)->check(CLI::Range(16, 8192));
    app.add_option("--height", options.size_px.y)->check(CLI::Range(16, 8192));
    app.add_option("--steps", options.steps, "Before it is drawn")->check(CLI::Range(1, 100000));
    app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 100000));
    app.add_option("--sampling", options.sampling)->check(CLI::IsMember({"rays", "axis", "view"}));
    app.add_flag("!--plain", options.puffs, "Without puffs");
    return bench::run(app, argc, argv, [&] { measure(options); });
}
