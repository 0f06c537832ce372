// SPDX-License-Identifier: MIT
#include "scene/assimp/ply_header.hpp"

#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

constexpr uint64_t longest_line = 4096;
constexpr uint32_t most_lines = 10000;

/// A line up to any line end, or what fits into the longest one.
bool read_line(std::istream& file, std::string& line)
{
    line.clear();
    for (int character = file.get(); character != std::char_traits<char>::eof(); character = file.get()) {
        if (character == '\n' || line.size() == longest_line)
            return true;
        if (character != '\r')
            line += static_cast<char>(character);
    }
    return !line.empty();
}

} // namespace

void check_ply_header(const std::filesystem::path& path, uint64_t file_bytes)
{
    std::ifstream file(path, std::ios::binary);
    const auto refuse = [&path](uint32_t line_number, const std::string& what) {
        throw Error(what, fmt::format("{}:{}", path.string(), line_number), "check that the file is whole");
    };
    std::string line;
    uint64_t promised = 0;
    for (uint32_t number = 1; number <= most_lines && read_line(file, line); ++number) {
        std::istringstream words(line);
        std::string word, element;
        words >> word;
        if (number == 1 && word != "ply")
            refuse(1, "is not a PLY file");
        if (word == "end_header") {
            // Each element takes at least one byte.
            const auto head_bytes = static_cast<uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
            if (promised > file_bytes - std::min(head_bytes, file_bytes))
                refuse(number,
                       fmt::format("promises {} elements, more than the file has room for", promised));
            return;
        }
        if (word != "element")
            continue;
        uint64_t count = 0;
        if (!(words >> element >> count) || count > std::numeric_limits<uint32_t>::max())
            refuse(number, fmt::format("\"{}\" has no usable count", line.substr(0, 80)));
        promised += count;
    }
    refuse(1, "has no end_header");
}

} // namespace estampe
