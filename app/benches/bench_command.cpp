// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>
#include <system_error>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "benches/measure.hpp"
#include "benches/tables.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

void write_text(const std::string& file, const std::string& text)
{
    write_file_atomically(file, std::as_bytes(std::span(text)));
}

void make_folder(const std::string& folder)
{
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) {
        throw Error("cannot make the folder", folder, problem.message());
    }
}

std::vector<const Series*> wanted(const std::vector<std::string>& names)
{
    std::vector<const Series*> result;
    for (const Series& series : all_series()) {
        if (names.empty() || std::ranges::find(names, series.name) != names.end()) {
            result.push_back(&series);
        }
    }
    return result;
}

} // namespace

void run(const BenchCommand& command)
{
    if (!command.compared.empty()) {
        fmt::print("{}", comparison_of(read_bench_json(command.compared.front()),
                                       read_bench_json(command.compared.back())));
        return;
    }
    for (const std::string& file : {command.json, command.csv}) {
        if (!file.empty()) {
            check_output(file, {});
        }
    }
    if (!command.plots.empty()) {
        make_folder(command.plots);
    }
    const BenchPlan plan{.device = command.device,
                         .width = command.width,
                         .height = command.height,
                         .frames = command.frames,
                         .most_share = command.most_share};
    const BenchResult result = measure(wanted(command.names), plan, [](const Series& series, double amount) {
        fmt::print(stderr, "{}: {:.0f} {}\n", series.name, amount, series.work);
    });
    fmt::print("{}", text_of(result));
    if (!command.json.empty()) {
        write_text(command.json, json_of(result));
    }
    if (!command.csv.empty()) {
        write_text(command.csv, csv_of(result));
    }
    if (!command.plots.empty()) {
        for (const BenchSeries& series : result.series) {
            write_text((std::filesystem::path(command.plots) / (series.name + ".svg")).string(),
                       plot_of(series, result));
        }
    }
}

} // namespace estampe::app
