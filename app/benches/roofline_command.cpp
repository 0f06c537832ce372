// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <span>

#include <fmt/format.h>

#include "benches/roofline/roofline.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "text.hpp"

namespace estampe::app {

void run(const BenchRooflineCommand& command)
{
    for (const std::string& file : {command.json, command.csv}) {
        if (!file.empty()) {
            check_output(file, {});
        }
    }
    std::vector<const roofline::Entry*> wanted;
    for (const roofline::Entry& entry : roofline::all_pictures()) {
        if (command.names.empty() || std::ranges::find(command.names, entry.name) != command.names.end()) {
            wanted.push_back(&entry);
        }
    }
    const roofline::Result result = roofline::measure(
        wanted,
        {.device = command.device,
         .width = command.width,
         .height = command.height,
         .frames = command.frames,
         .least_share = command.least_share},
        [](const roofline::Entry& entry) { fmt::print(stderr, "{}: {}\n", entry.name, entry.about); });
    fmt::print("{}", text_of(result));
    if (!command.json.empty()) {
        const std::string json = json_of(result);
        write_file_atomically(command.json, std::as_bytes(std::span(json)));
    }
    if (!command.csv.empty()) {
        const std::string csv = csv_of(result);
        write_file_atomically(command.csv, std::as_bytes(std::span(csv)));
    }
}

} // namespace estampe::app
