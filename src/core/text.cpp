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

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    for (char& letter : lower) {
        if (letter >= 'A' && letter <= 'Z') {
            letter = static_cast<char>(letter - 'A' + 'a');
        }
    }
    return lower;
}

std::string_view trimmed(std::string_view text, std::string_view around)
{
    const size_t first = text.find_first_not_of(around);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(around) - first + 1);
}

void replace_all(std::string& text, const std::string& what, const std::string& with)
{
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
}

void say(const std::string& text)
{
    static_cast<void>(std::fputs(text.c_str(), stderr));
}

} // namespace estampe
