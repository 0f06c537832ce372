// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <span>

#include <fmt/format.h>

#include "benches/lab/lab.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "text.hpp"

namespace estampe::app {

void run(const BenchLabCommand& command)
{
    for (const std::string& file : {command.json, command.csv}) {
        if (!file.empty()) {
            check_output(file, {});
        }
    }
    std::vector<const lab::Entry*> wanted;
    for (const lab::Entry& entry : lab::all_experiments()) {
        if (command.names.empty() || std::ranges::find(command.names, entry.name) != command.names.end()) {
            wanted.push_back(&entry);
        }
    }
    const lab::LabResult result =
        lab::run_lab(command.device, wanted, command.rounds, [](const lab::Entry& entry) {
            fmt::print(stderr, "{}: {}\n", entry.name, entry.about);
        });
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
