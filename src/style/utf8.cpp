// SPDX-License-Identifier: MIT
#include "style/utf8.hpp"

#include <algorithm>
#include <string>

#include <array>
#include <cstdint>

namespace estampe::style {
namespace {

/// Characters of one length: those whose first byte is `first` to `last`, from `least` to `most`.
struct Form {
    uint8_t first, last;
    uint32_t least, most;
};

constexpr std::array<Form, 4> forms{{{0x00, 0x7F, 0x0, 0x7F},
                                     {0xC2, 0xDF, 0x80, 0x7FF},
                                     {0xE0, 0xEF, 0x800, 0xFFFF},
                                     {0xF0, 0xF4, 0x10000, 0x10FFFF}}};

/// The length of the character that `text` begins with; 0 when it is none.
size_t character_length(std::string_view text)
{
    constexpr uint32_t surrogates_begin = 0xD800;
    constexpr uint32_t surrogates_end = 0xE000;
    const auto byte = [text](size_t i) { return static_cast<uint8_t>(text[i]); };
    for (size_t length = 1; length <= forms.size(); ++length) {
        const Form& form = forms[length - 1];
        if (byte(0) < form.first || byte(0) > form.last) {
            continue;
        }
        if (length > text.size()) {
            return 0;
        }
        uint32_t code = length == 1 ? byte(0) : byte(0) & (0x7FU >> length);
        for (size_t i = 1; i < length; ++i) {
            if ((byte(i) & 0xC0U) != 0x80U) {
                return 0;
            }
            code = code << 6U | (byte(i) & 0x3FU);
        }
        const bool is_surrogate = code >= surrogates_begin && code < surrogates_end;
        return code >= form.least && code <= form.most && !is_surrogate ? length : 0;
    }
    return 0;
}

/// Behind the string that begins at `at`, of one line or of several; of one that does not end, behind its
/// line or the text.
size_t end_of_string(std::string_view text, size_t at)
{
    const char quote = text[at];
    const std::string three(3, quote);
    const bool has_lines = text.substr(at).starts_with(three);
    const size_t quotes = has_lines ? 3 : 1;
    for (at += quotes; at < text.size(); ++at) {
        if (text[at] == '\\' && quote == '"') {
            ++at;
        } else if (text.substr(at).starts_with(std::string_view(three).substr(0, quotes))) {
            return at + quotes;
        } else if (text[at] == '\n' && !has_lines) {
            return at;
        }
    }
    return text.size();
}

} // namespace

size_t first_not_utf8(std::string_view text)
{
    size_t at = 0;
    while (at < text.size()) {
        const size_t length = character_length(text.substr(at));
        if (length == 0) {
            break;
        }
        at += length;
    }
    return at;
}

size_t first_bare_beyond_ascii(std::string_view text)
{
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    size_t at = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    while (at < text.size() && static_cast<unsigned char>(text[at]) < 0x80U) {
        const char character = text[at];
        if (character == '#') {
            at = std::min(text.find('\n', at), text.size());
        } else if (character == '"' || character == '\'') {
            at = end_of_string(text, at);
        } else {
            ++at;
        }
    }
    return at;
}

} // namespace estampe::style
