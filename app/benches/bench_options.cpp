// SPDX-License-Identifier: MIT
#include "benches/bench_options.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "benches/lab/lab.hpp"
#include "benches/roofline/roofline.hpp"
#include "benches/series.hpp"
#include "core/file.hpp"
#include "no_cache.hpp"
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

std::string lab_footer()
{
    std::string text = R"(Examples:
  estampe bench lab
  estampe bench lab reads order --rounds 25 --json here.json

Each experiment does one thing in several ways, in turn, and checks what each leaves. docs/laboratory.md
explains what they show.

Experiments:
)";
    for (const lab::Entry& entry : lab::all_experiments()) {
        text += fmt::format("  {:<12} {}\n", entry.name, entry.about);
    }
    return text;
}

std::string roofline_footer()
{
    std::string text = R"(Examples:
  estampe bench roofline
  estampe bench roofline field --size 1920x1080 --json here.json

Each pass runs by itself. Its bytes are those of what it binds, each once; its operations are counted in its
shader, loops once: so of kernels that loop the share of the arithmetic is the least. docs/performance.md says
more.

Pictures:
)";
    for (const roofline::Entry& entry : roofline::all_pictures()) {
        text += fmt::format("  {:<12} {}\n", entry.name, entry.about);
    }
    return text;
}

/// Throws UsageError, telling what there is, unless each of `names` is among `known`.
void check_names(const std::vector<std::string>& names, const std::vector<std::string>& known,
                 const char* what, const char* command)
{
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) == known.end()) {
            throw UsageError(fmt::format("there is no {} {}", what, in_quotes(name)), command,
                             fmt::format("there are {}", fmt::join(known, ", ")));
        }
    }
}

template <class Entries>
std::vector<std::string> names_of(const Entries& entries)
{
    std::vector<std::string> names;
    names.reserve(std::size(entries));
    for (const auto& entry : entries) {
        names.emplace_back(entry.name);
    }
    return names;
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
    add_files_to(bench);
    bench.add_option("--plots", plots_, "Also write NAME.svg for each series, cost over work, into DIR")
        ->type_name("DIR");
    bench.add_option("--most", most_share_, "Leave out amounts above this share of a series' greatest")
        ->type_name("SHARE")
        ->capture_default_str();
    add_common_to(bench);
    add_lights_to(bench);
    add_lab_to(bench);
    add_roofline_to(bench);
}

void BenchOptions::add_files_to(CLI::App& command)
{
    command.add_option("--json", json_file_, "Also write all that was measured as JSON")->type_name("FILE");
    command.add_option("--csv", csv_file_, "Also write a row for each measurement as CSV")->type_name("FILE");
}

void BenchOptions::add_lab_to(CLI::App& bench)
{
    lab_ = bench.add_subcommand("lab", "Small kernels that show what makes a shader quick or slow here");
    lab_->footer(lab_footer());
    lab_->add_option("NAME", names_, "Experiments to run, see below [all]")->type_name("NAME");
    lab_->add_option("--rounds", frames_, "How often each kernel is run, of which the median counts")
        ->type_name("N")
        ->capture_default_str();
    add_no_cache_flag(*lab_);
    lab_->add_option("--device", device_, "auto, cpu, or an index that estampe devices lists")
        ->type_name("DEVICE")
        ->capture_default_str();
    add_files_to(*lab_);
}

void BenchOptions::add_roofline_to(CLI::App& bench)
{
    roofline_ =
        bench.add_subcommand("roofline", "Hold each pass against what the device can copy and compute");
    roofline_->footer(roofline_footer());
    roofline_->add_option("NAME", names_, "Pictures to draw, see below [all]")->type_name("NAME");
    roofline_->add_option("--least", least_share_, "Leave out passes below this share of a picture's time")
        ->type_name("SHARE")
        ->capture_default_str();
    add_common_to(*roofline_);
    add_files_to(*roofline_);
}

void BenchOptions::add_common_to(CLI::App& command)
{
    command.add_option("--size", size_, "Width and height in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command.add_option("--frames", frames_, "Frames of each kind, of which the median counts")
        ->type_name("N")
        ->capture_default_str();
    add_no_cache_flag(command);
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

Command BenchOptions::read() const
{
    if (lights_->parsed()) {
        return read_lights();
    }
    if (lab_->parsed()) {
        return read_lab();
    }
    if (roofline_->parsed()) {
        return read_roofline();
    }
    return read_series();
}

RendererOptions BenchOptions::device() const
{
    constexpr uint32_t most_frames = 10000;
    check_count("--frames", frames_, most_frames);
    check_device(device_);
    return {.device = device_, .raster = parse_raster_path(raster_)};
}

BenchCommand BenchOptions::read_series() const
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
    check_names(names_, names_of(all_series()), "series", "bench");
    return bench;
}

BenchLabCommand BenchOptions::read_lab() const
{
    constexpr uint32_t most_rounds = 10000;
    check_count("--rounds", frames_, most_rounds);
    check_device(device_);
    check_extension(json_file_, "--json", ".json");
    check_extension(csv_file_, "--csv", ".csv");
    check_names(names_, names_of(lab::all_experiments()), "experiment", "bench lab");
    return {.names = names_, .rounds = frames_, .device = device_, .json = json_file_, .csv = csv_file_};
}

BenchRooflineCommand BenchOptions::read_roofline() const
{
    BenchRooflineCommand bench{.names = names_,
                               .frames = frames_,
                               .least_share = least_share_,
                               .device = device(),
                               .json = json_file_,
                               .csv = csv_file_};
    std::tie(bench.width, bench.height) = parse_size(size_);
    check_extension(json_file_, "--json", ".json");
    check_extension(csv_file_, "--csv", ".csv");
    if (!(least_share_ >= 0.0 && least_share_ < 1.0)) {
        throw UsageError("is out of range", fmt::format("--least {}", least_share_),
                         "allowed: from 0, below 1");
    }
    check_names(names_, names_of(roofline::all_pictures()), "picture", "bench roofline");
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
