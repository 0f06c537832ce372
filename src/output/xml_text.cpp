// SPDX-License-Identifier: MIT
#include "output/xml_text.hpp"

#include <algorithm>
#include <map>

namespace estampe::output {
namespace {

/// Length of the UTF-8 sequence that starts at `i`; 0 where none does.
size_t sequence_length(const std::string& text, size_t i)
{
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t length = first < 0x80                    ? 1
                          : first >= 0xc2 && first < 0xe0 ? 2
                          : first >= 0xe0 && first < 0xf0 ? 3
                          : first >= 0xf0 && first < 0xf5 ? 4
                                                          : 0;
    for (size_t k = 1; k < length; ++k) {
        if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80) {
            return 0;
        }
    }
    return length;
}

} // namespace

std::string escaped(const std::string& text)
{
    static const std::map<char, std::string> own{
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    std::string result;
    result.reserve(text.size());
    for (size_t i = 0; i < text.size();) {
        const size_t length = sequence_length(text, i);
        const auto written = own.find(text[i]);
        if (length == 0) {
            result += '?';
        } else if (written != own.end()) {
            result += written->second;
        } else if (static_cast<unsigned char>(text[i]) < 0x20) {
            result += ' ';
        } else {
            result += text.substr(i, length);
        }
        i += std::max<size_t>(length, 1);
    }
    return result;
}

} // namespace estampe::output
