// SPDX-License-Identifier: MIT
#pragma once

// The option --confine: which files a command may read and write.

#include <filesystem>
#include <string>

#include <estampe/read_scope.hpp>

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The scopes of reading that --confine sets.
struct Confinement {
    bool is_on = false; ///< --confine was given on the command line
    /// Folder of the jobs file, whose jobs may name files only below it. Without a limit outside of a batch.
    ReadScope jobs;

    /// Returns the scope for a file that the command line or a job names, and for the files that this file
    /// names: the folder of the jobs file, or else the folder of `file`. Without --confine: no limit.
    [[nodiscard]] ReadScope of(const std::filesystem::path& file) const;

    bool operator==(const Confinement&) const = default;
};

/// Adds the option --confine to the command; `is_on` must outlive the parsing.
void add_confine_flag(CLI::App& command, bool& is_on);

/// Checks a file or folder that a command is about to write, within the scope of --confine. Throws Error if
/// the scope is limited and the path leads out of it, or ends at or goes through a symbolic link.
void check_output_inside(const std::filesystem::path& output, const ReadScope& scope);

/// Throws the error that is being handled, without any text of the file in which it occurred: a file that a
/// job names may be anything, such as a file with passwords. `role` is what the file should be, and `command`
/// the command of the program that says what is wrong in it.
[[noreturn]] void rethrow_unquoted(const std::string& role, const std::string& command);

/// Calls `read`, which reads a text file, and returns its result. Errors are those of rethrow_unquoted().
template <typename Read>
auto unquoted(const std::string& role, const std::string& command, const Read& read)
{
    try {
        return read();
    } catch (...) {
        rethrow_unquoted(role, command);
    }
}

} // namespace estampe::app
