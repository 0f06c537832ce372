// SPDX-License-Identifier: MIT
#include "benches/bench_options.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "benches/series.hpp"
#include "option_values.hpp"
#include "text.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

constexpr const char* lights_examples = R"(Examples:
  estampe bench lights -o lights.svg
  estampe bench lights --counts 34 --shadowed 4 --million --size 1920x1080 --json

Each count is measured in turn with frames without local lights, so that the ratio of the two does not hang
on how busy the machine is.)";

std::string bench_footer()
{
    std::string text = R"(Examples:
  estampe bench
  estampe bench triangles cloth --size 1920x1080 --json after.json --plots plots
  estampe bench --compare before.json after.json

Each amount of work is measured in turn with the series' first, so that the ratio of the two does not hang on
how busy the machine is. On a processor wall time is the cost, and amounts that take it minutes are left out.

Series:
)";
    for (const Series& series : all_series()) {
        text += fmt::format("  {:<12} {}\n", series.name, series.about);
    }
    return text;
}

void check_extension(const std::string& file, const char* option, const char* extension)
{
    if (!file.empty() && lower_extension(file) != extension) {
        throw UsageError(fmt::format("the name must end in {}", extension),
                         fmt::format("{} {}", option, file));
    }
}

} // namespace

void BenchOptions::add_to(CLI::App& app)
{
    CLI::App& bench = *app.add_subcommand("bench", "Measure what things cost, on scenes of its own");
    bench.footer(bench_footer());
    bench.add_option("NAME", names_, "Series to measure, see below [all]")->type_name("NAME");
    bench.add_option("--compare", compared_, "Do not measure: tell how two results differ")
        ->type_name("A.json B.json")
        ->expected(2);
    bench.add_option("--json", json_file_, "Also write all that was measured as JSON")->type_name("FILE");
    bench.add_option("--csv", csv_file_, "Also write a row for each amount as CSV")->type_name("FILE");
    bench.add_option("--plots", plots_, "Also write NAME.svg for each series, cost over work, into DIR")
        ->type_name("DIR");
    bench.add_option("--most", most_share_, "Leave out amounts above this share of a series' greatest")
        ->type_name("SHARE")
        ->capture_default_str();
    add_common_to(bench);
    add_lights_to(bench);
}

void BenchOptions::add_common_to(CLI::App& command)
{
    command.add_option("--size", size_, "Width and height in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command.add_option("--frames", frames_, "Frames of each kind, of which the median counts")
        ->type_name("N")
        ->capture_default_str();
    command.add_option("--device", device_, "auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    command.add_option("--raster", raster_, "hardware, compute, or auto")
        ->type_name("PATH")
        ->capture_default_str();
}

void BenchOptions::add_lights_to(CLI::App& bench)
{
    lights_ = bench.add_subcommand("lights", "Cost against the number of lights");
    lights_->footer(lights_examples);
    lights_->add_option("--counts", counts_, "How many local lights [1 3 10 30 100 300 1000]")
        ->type_name("N,N,...")
        ->delimiter(',');
    lights_->add_option("--shadowed", shadowed_, "How many of them throw shadows: spots and points in turn")
        ->type_name("N")
        ->capture_default_str();
    lights_->add_flag("--million", million_, "A million triangles instead of some ten thousand");
    lights_->add_flag("--moving", moving_, "Move the lights that throw shadows from frame to frame");
    add_common_to(*lights_);
    lights_->add_option("-o,--output", output_, "Also write a plot, NAME.svg")->type_name("FILE");
    lights_->add_flag("--json", json_, "Print JSON");
}

bool BenchOptions::is_of_lights() const
{
    return lights_ != nullptr && lights_->parsed();
}

RendererOptions BenchOptions::device() const
{
    constexpr uint32_t most_frames = 10000;
    check_count("--frames", frames_, most_frames);
    check_device(device_);
    return {.device = device_, .raster = parse_raster_path(raster_)};
}

BenchCommand BenchOptions::read() const
{
    BenchCommand bench{.names = names_,
                       .compared = compared_,
                       .json = json_file_,
                       .csv = csv_file_,
                       .plots = plots_,
                       .most_share = most_share_,
                       .frames = frames_,
                       .device = device()};
    std::tie(bench.width, bench.height) = parse_size(size_);
    check_extension(json_file_, "--json", ".json");
    check_extension(csv_file_, "--csv", ".csv");
    if (!(most_share_ > 0.0 && most_share_ <= 1.0)) {
        throw UsageError("is out of range", fmt::format("--most {}", most_share_),
                         "allowed: above 0, up to 1");
    }
    if (!compared_.empty() &&
        !(names_.empty() && json_file_.empty() && csv_file_.empty() && plots_.empty())) {
        throw UsageError("measures nothing", "--compare", "leave out series and files to write");
    }
    for (const std::string& name : names_) {
        const auto& series = all_series();
        if (std::ranges::none_of(series, [&](const Series& one) { return one.name == name; })) {
            std::vector<std::string> known;
            known.reserve(series.size());
            for (const Series& one : series) {
                known.emplace_back(one.name);
            }
            throw UsageError(fmt::format("there is no series {}", in_quotes(name)), "bench",
                             fmt::format("there are {}", fmt::join(known, ", ")));
        }
    }
    return bench;
}

BenchLightsCommand BenchOptions::read_lights() const
{
    constexpr uint32_t most_lights = 100000;
    BenchLightsCommand bench{.shadowed = shadowed_,
                             .million = million_,
                             .moving = moving_,
                             .frames = frames_,
                             .device = device(),
                             .output = output_,
                             .json = json_};
    if (!counts_.empty()) {
        bench.counts = counts_;
    }
    for (const uint32_t count : bench.counts) {
        check_count("--counts", count, most_lights);
    }
    std::tie(bench.width, bench.height) = parse_size(size_);
    if (!output_.empty() && lower_extension(output_) != ".svg") {
        throw UsageError("the plot is an SVG picture", "-o " + output_, "the name must end in .svg");
    }
    return bench;
}

} // namespace estampe::app
