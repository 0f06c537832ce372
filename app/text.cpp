// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <unistd.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::app {

std::string one_line(std::string_view text)
{
    std::string line;
    for (const char character : text) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x20 || byte == 0x7F) {
            line += fmt::format("\\x{:02x}", byte);
        } else {
            line += character;
        }
    }
    return line;
}

std::string shortened(const std::string& text)
{
    constexpr size_t longest = 2000;
    constexpr size_t part = longest / 2;
    return text.size() <= longest ? text : text.substr(0, part) + " ... " + text.substr(text.size() - part);
}

std::string in_quotes(std::string_view text)
{
    return '"' + one_line(text) + '"';
}

void say(const std::string& text)
{
    static_cast<void>(std::fputs(text.c_str(), stderr));
}

void print_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) {
        say(fmt::format("estampe: warning: {}\n", shortened(one_line(warning))));
    }
}

void print_notes(const std::vector<std::string>& notes)
{
    for (const std::string& note : notes) {
        say(fmt::format("estampe: note: {}\n", shortened(one_line(note))));
    }
}

void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs)
{
    std::error_code problem;
    const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, problem)) {
        throw Error("there is no such folder", folder.string(),
                    "create it first, or write elsewhere with -o");
    }
    const std::filesystem::file_status status = std::filesystem::status(output, problem);
    if (problem == std::errc::filename_too_long) { // found out now, before other files have their names
        throw Error(fmt::format("cannot write: {}", problem.message()), output.string(),
                    "choose a shorter name");
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error("exists and is not a regular file", output.string(), "choose another name for -o");
    }
    for (const std::filesystem::path& input : inputs) {
        if (std::filesystem::equivalent(output, input, problem)) {
            throw Error("the output would overwrite an input", output.string(), "choose another name for -o");
        }
    }
    std::string probe = (folder / ".estampe-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) {
        throw Error(fmt::format("cannot write into this folder: {}", std::strerror(errno)), folder.string(),
                    "write elsewhere with -o");
    }
    close(file);
    unlink(probe.c_str());
}

} // namespace estampe::app
