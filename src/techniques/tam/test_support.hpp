// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <estampe/error.hpp>

#include "techniques/tam/maker.hpp"

namespace estampe::tam::testing {

/// A map that is quick to draw.
inline TamStyle small_style(Tool tool = Tool::pen, int size_px = 128)
{
    TamStyle style;
    style.tool = tool;
    style.size_px = size_px;
    style.tones = 4;
    style.length_px = 60.0F;
    style.candidates = 16;
    style.second_from = 3;
    return style;
}

/// A folder that goes when the test ends.
class Folder {
public:
    Folder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "estampe-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }

    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    ~Folder() { std::filesystem::remove_all(path_); }

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The message of the Error that `job` throws; empty when it throws none.
template <typename Job>
std::string message_of(Job job)
{
    try {
        job();
    } catch (const Error& problem) {
        return problem.what();
    }
    return {};
}

} // namespace estampe::tam::testing
