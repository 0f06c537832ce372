// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "lab/commands.hpp"
#include "lab/kernels/kernels.hpp"

namespace estampe::lab {
namespace {

struct KernelsOptions {
    std::vector<std::string> names; ///< of experiments; empty: all
    uint32_t rounds = 9;
    std::string device = "auto";
    ResultFiles files;
};

std::string kernels_footer()
{
    return R"(Examples:
  estampe_lab kernels
  estampe_lab kernels reads order --rounds 25 --json here.json

Each experiment does one thing in several ways, in turn, and checks what each leaves. docs/laboratory.md
explains what they show.

Experiments:
)" + list_of(kernels::all_experiments());
}

void run_kernels(const KernelsOptions& options)
{
    options.files.check();
    const kernels::KernelsResult result = kernels::run_experiments(
        options.device, chosen(kernels::all_experiments(), options.names), options.rounds,
        [](const kernels::Entry& entry) { fmt::print(stderr, "{}: {}\n", entry.name, entry.about); });
    fmt::print("{}", text_of(result));
    options.files.write(result);
}

} // namespace

Job add_kernels(CLI::App& command)
{
    const auto options = std::make_shared<KernelsOptions>();
    command.footer(kernels_footer());
    command.add_option("NAME", options->names, "Experiments to run, see below [all]")
        ->type_name("NAME")
        ->check(bench::one_of("experiment", names_of(kernels::all_experiments())));
    command
        .add_option("--rounds", options->rounds, "How often each kernel is run, of which the median counts")
        ->type_name("N")
        ->capture_default_str()
        ->check(bench::up_to(10000));
    bench::add_no_cache_flag(command);
    bench::add_device_option(command, options->device);
    options->files.add_to(command);
    return [options] { run_kernels(*options); };
}

} // namespace estampe::lab
