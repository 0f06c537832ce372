// SPDX-License-Identifier: MIT
#pragma once

// The commands of estampe_lab. Each function adds the options of one command to `command`. It returns the job
// that runs the command after the command line is parsed. The job throws Error when something cannot be
// measured or written.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/command_line.hpp"

namespace estampe::lab {

using bench::Job;

/// Measures the series, or compares two results.
[[nodiscard]] Job add_series(CLI::App& command);

/// Measures what lights cost.
[[nodiscard]] Job add_lights(CLI::App& command);

/// Runs the kernels that show which constructs make a shader fast or slow.
[[nodiscard]] Job add_kernels(CLI::App& command);

/// Compares each pass with the copy and arithmetic speed of the device.
[[nodiscard]] Job add_roofline(CLI::App& command);

/// Adds the options of all commands that draw pictures: the pictures' size, the number of frames, and the
/// device's options.
void add_drawing_options(CLI::App& command, bench::Size& size, uint32_t& frames, RendererOptions& device);

/// Files that receive the result in addition to standard output.
class ResultFiles {
public:
    /// Adds --json and --csv. This object must outlive the job.
    void add_to(CLI::App& command);

    [[nodiscard]] bool is_any() const { return !json_.empty() || !csv_.empty(); }

    /// Throws Error if a file cannot be written. Called before anything is measured.
    void check() const;

    /// Writes json_of(result) and csv_of(result) to the requested files.
    template <class Result>
    void write(const Result& result) const
    {
        write_text(json_, [&] { return json_of(result); });
        write_text(csv_, [&] { return csv_of(result); });
    }

    /// Calls `text` and writes what it returns, unless `file` is empty.
    static void write_text(const std::string& file, const std::function<std::string()>& text);

private:
    std::string json_;
    std::string csv_;
};

/// The names of `entries`.
template <class Entries>
[[nodiscard]] std::vector<std::string> names_of(const Entries& entries)
{
    std::vector<std::string> names;
    names.reserve(entries.size());
    for (const auto& entry : entries) {
        names.emplace_back(entry.name);
    }
    return names;
}

/// The entries of those names; all entries if `names` is empty.
template <class Entry>
[[nodiscard]] std::vector<const Entry*> chosen(const std::vector<Entry>& entries,
                                               const std::vector<std::string>& names)
{
    std::vector<const Entry*> result;
    for (const Entry& entry : entries) {
        if (names.empty() || std::ranges::find(names, entry.name) != names.end()) {
            result.push_back(&entry);
        }
    }
    return result;
}

/// One line per entry: the entry's name and its description.
template <class Entries>
[[nodiscard]] std::string list_of(const Entries& entries)
{
    std::string list;
    for (const auto& entry : entries) {
        list += fmt::format("  {:<12} {}\n", entry.name, entry.about);
    }
    return list;
}

} // namespace estampe::lab
