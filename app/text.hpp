// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::app {

/// `text` on one line: control characters, which could command a terminal, become "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// The same, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Writes "estampe: warning: ..." to stderr for each.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes "estampe: note: ..." to stderr for each.
void print_notes(const std::vector<std::string>& notes);

/// Throws Error when a file cannot be written to `output`: no such folder, no right to write there, a folder
/// in its place, or when it is one of the `inputs`. Nothing at `output` is touched.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

} // namespace estampe::app
