// SPDX-License-Identifier: MIT
// Measures the cost of drawing on this device: series of growing work, lights, single kernels, and each pass
// compared with the device's limits. estampe_lab --help

#include "common/command_line.hpp"
#include "lab/commands.hpp"

int main(int argc, char** argv)
{
    using namespace estampe;      // NOLINT(google-build-using-namespace): a program of one file
    using namespace estampe::lab; // NOLINT(google-build-using-namespace)
    CLI::App app("Measures what drawing costs, on scenes of its own.", "estampe_lab");
    app.require_subcommand(0, 1);
    app.get_formatter()->column_width(34);
    Job job = add_series(app);
    bench::add_command(app, "lights", "Measure cost against the number of lights", add_lights, job);
    bench::add_command(app, "kernels", "Run small kernels that show what makes a shader quick or slow here",
                       add_kernels, job);
    bench::add_command(app, "roofline", "Hold each pass against what the device can copy and compute",
                       add_roofline, job);
    return bench::run(app, argc, argv, [&] { job(); });
}
