// SPDX-License-Identifier: MIT
#include "core/check_output.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {

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

} // namespace estampe
