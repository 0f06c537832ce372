// SPDX-License-Identifier: MIT
#include "lab/commands.hpp"

#include <span>

#include "common/command_line.hpp"
#include "core/file.hpp"

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

} // namespace estampe::lab
