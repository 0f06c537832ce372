// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/command_line.hpp"
#include "lab/commands.hpp"
#include "lab/roofline/roofline.hpp"

namespace estampe::lab {
namespace {

struct RooflineOptions {
    std::vector<std::string> names; ///< of pictures; empty: all
    roofline::Plan plan;
    bench::Size size;
    ResultFiles files;
};

std::string roofline_footer()
{
    return R"(Examples:
  estampe_lab roofline
  estampe_lab roofline field --size 1920x1080 --json here.json

Each pass runs by itself. Its bytes are those of all that it binds, each counted once; its operations are
counted in its shader, each loop once, so that the share of the arithmetic is a lower bound for kernels that
loop. docs/performance.md says more.

Pictures:
)" + list_of(roofline::all_pictures());
}

void measure_passes(RooflineOptions& options)
{
    options.files.check();
    options.plan.width = options.size.width;
    options.plan.height = options.size.height;
    const roofline::Result result = roofline::measure(
        chosen(roofline::all_pictures(), options.names), options.plan,
        [](const roofline::Entry& entry) { fmt::print(stderr, "{}: {}\n", entry.name, entry.about); });
    fmt::print("{}", text_of(result));
    options.files.write(result);
}

} // namespace

Job add_roofline(CLI::App& command)
{
    const auto options = std::make_shared<RooflineOptions>();
    command.footer(roofline_footer());
    command.add_option("NAME", options->names, "Pictures to draw, see below [all]")
        ->type_name("NAME")
        ->check(bench::one_of("picture", names_of(roofline::all_pictures())));
    command
        .add_option("--least", options->plan.least_share,
                    "Leave out passes below this share of a picture's time")
        ->type_name("SHARE")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 0.999999).description(""));
    add_drawing_options(command, options->size, options->plan.frames, options->plan.device);
    options->files.add_to(command);
    return [options] { measure_passes(*options); };
}

} // namespace estampe::lab
