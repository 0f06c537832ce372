// SPDX-License-Identifier: MIT
#include "core/text.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace estampe {

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

} // namespace estampe
