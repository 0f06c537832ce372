// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::app {

/// `text` on one line: control characters, which could command a terminal, become "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// `text`, or where it is too long to be read its beginning and its end.
[[nodiscard]] std::string shortened(const std::string& text);

/// One line, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Writes to stderr. Where that is full or closed nothing is said, and nothing fails for it.
void say(const std::string& text);

/// Writes "estampe: warning: ..." to stderr for each.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes "estampe: note: ..." to stderr for each.
void print_notes(const std::vector<std::string>& notes);

/// Throws Error when a file cannot be written to `output`: no such folder, no right to write there, a folder
/// in its place, or when it is one of the `inputs`. Nothing at `output` is touched.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

} // namespace estampe::app
