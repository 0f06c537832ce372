// SPDX-License-Identifier: MIT
#include "confine.hpp"

#include <cerrno>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/read_scope.hpp"
#include "core/text.hpp"

namespace estampe::app {

ReadScope Confinement::of(const std::filesystem::path& file) const
{
    if (!is_on) {
        return {};
    }
    return jobs.is_limited() ? jobs : ReadScope::beside(file);
}

void add_confine_flag(CLI::App& command, bool& is_on)
{
    command.add_flag("--confine", is_on,
                     "Read no file outside the folder of each file that is named here. For\n"
                     "files of strangers: paths with .. and symbolic links are refused.");
}

void rethrow_unquoted(const std::string& role, const std::string& command)
{
    try {
        throw;
    } catch (const OutsideScope&) {
        throw;
    } catch (const Error& problem) {
        // A place with a line or a column, such as file:3:1, is in the text of the file.
        const std::string& where = problem.where();
        const size_t colon = where.rfind(':');
        const bool is_in_text =
            colon != std::string::npos && number_from<uint32_t>(std::string_view(where).substr(colon + 1));
        if (!is_in_text) {
            throw; // The message names the file and quotes nothing of it
        }
        throw Error(fmt::format("is no {}", role), where,
                    fmt::format("estampe {} with the name of this file says why", command));
    }
}

void check_output_inside(const std::filesystem::path& output, const ReadScope& scope)
{
    if (!scope.is_limited()) {
        return;
    }
    // Folders that are missing are made later; the nearest one that exists decides.
    std::filesystem::path existing = output;
    int opened = open_to_read(existing, scope, O_PATH);
    while (opened < 0 && errno == ENOENT && existing.has_relative_path()) {
        existing = existing.parent_path();
        opened = open_to_read(existing, scope, O_PATH);
    }
    if (opened >= 0) {
        close(opened);
    }
}

} // namespace estampe::app
