// SPDX-License-Identifier: MIT
#include "lab/commands.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "common/command_line.hpp"
#include "core/file.hpp"
#include "lab/series.hpp"
#include "lab/tables.hpp"

namespace estampe::lab {

void ResultFiles::add_to(CLI::App& command)
{
    command.add_option("--json", json_, "Also write all that was measured as JSON")
        ->type_name("FILE")
        ->check(bench::ends_in(".json"));
    command.add_option("--csv", csv_, "Also write a row for each measurement as CSV")
        ->type_name("FILE")
        ->check(bench::ends_in(".csv"));
}

void ResultFiles::check() const
{
    for (const std::string& file : {json_, csv_}) {
        if (!file.empty()) {
            check_output(file, {});
        }
    }
}

void ResultFiles::write_text(const std::string& file, const std::function<std::string()>& text)
{
    if (!file.empty()) {
        const std::string written = text();
        write_file_atomically(file, std::as_bytes(std::span(written)));
    }
}

void add_drawing_options(CLI::App& command, bench::Size& size, uint32_t& frames, RendererOptions& device)
{
    bench::add_size_option(command, size);
    command.add_option("--frames", frames, "Frames of each kind, of which the median counts")
        ->type_name("N")
        ->capture_default_str()
        ->check(bench::up_to(10000));
    bench::add_renderer_options(command, device);
}

namespace {

struct SeriesOptions {
    std::vector<std::string> names;    ///< names of series; empty: all
    std::vector<std::string> compared; ///< two .json files to compare; empty: measure
    std::string plots;                 ///< folder for plots; empty: no plots
    ResultFiles files;
    BenchPlan plan;
    bench::Size size;
};

std::string series_footer()
{
    return R"(Examples:
  estampe_lab
  estampe_lab triangles cloth --size 1920x1080 --json after.json --plots plots
  estampe_lab --compare before.json after.json

Each amount of work is measured in turn with the series' first amount, so that the ratio of the two does not
depend on how busy the machine is. On a processor wall time is the cost, and amounts that take it minutes are
left out.

Series:
)" + list_of(all_series()) +
           "\nExit status: 0 done, 1 measuring failed, 2 the command line is wrong.";
}

void make_folder(const std::string& folder)
{
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
        throw Error("cannot make the folder", folder, problem.message());
    }
}

void compare(const SeriesOptions& options)
{
    if (!options.names.empty() || options.files.is_any() || !options.plots.empty()) {
        throw CLI::ValidationError("--compare", "measures nothing: leave out series and files to write");
    }
    fmt::print("{}", comparison_of(read_bench_json(options.compared.front()),
                                   read_bench_json(options.compared.back())));
}

void measure_series(SeriesOptions& options)
{
    options.files.check();
    if (!options.plots.empty()) {
        make_folder(options.plots);
    }
    options.plan.width = options.size.width;
    options.plan.height = options.size.height;
    const BenchResult result =
        measure(chosen(all_series(), options.names), options.plan, [](const Series& series, double amount) {
            fmt::print(stderr, "{}: {:.0f} {}\n", series.name, amount, series.work);
        });
    fmt::print("{}", text_of(result));
    options.files.write(result);
    for (const BenchSeries& series : result.series) {
        if (!options.plots.empty()) {
            ResultFiles::write_text((std::filesystem::path(options.plots) / (series.name + ".svg")).string(),
                                    [&] { return plot_of(series, result); });
        }
    }
}

} // namespace

Job add_series(CLI::App& command)
{
    const auto options = std::make_shared<SeriesOptions>();
    command.footer(series_footer());
    command.add_option("NAME", options->names, "Series to measure, see below [all]")
        ->type_name("NAME")
        ->check(bench::one_of("series", names_of(all_series())));
    command.add_option("--compare", options->compared, "Do not measure: print how two results differ")
        ->type_name("A.json B.json")
        ->expected(2);
    options->files.add_to(command);
    command
        .add_option("--plots", options->plots,
                    "Also write NAME.svg for each series, cost over work, into DIR")
        ->type_name("DIR")
        ->check([](const std::string& folder) { return std::string(folder.empty() ? "is empty" : ""); });
    command
        .add_option("--most", options->plan.most_share,
                    "Leave out amounts above this share of a series' greatest")
        ->type_name("SHARE")
        ->capture_default_str()
        ->check(CLI::Range(1e-9, 1.0).description(""));
    add_drawing_options(command, options->size, options->plan.frames, options->plan.device);
    return [options] {
        if (options->compared.empty()) {
            measure_series(*options);
        } else {
            compare(*options);
        }
    };
}

} // namespace estampe::lab
