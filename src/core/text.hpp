// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace estampe {

/// `text` on one line: control characters, which could command a terminal, become "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// `text`, or its beginning and end if it is too long to read.
[[nodiscard]] std::string shortened(const std::string& text);

/// `text` on one line, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// `text` in lower case. Non-ASCII letters are unchanged, because their case depends on the language.
[[nodiscard]] std::string lower_case(std::string_view text);

/// `text` without the characters of `around` at its beginning and its end.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\n");

/// The number that is all of `text`, as std::from_chars reads it; nothing if there is none or it does not fit
/// the type.
template <typename Number>
[[nodiscard]] std::optional<Number> number_from(std::string_view text)
{
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    return problem == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

/// Replaces each `what` in `text` by `with`, from left to right. Replacements are not searched again.
void replace_all(std::string& text, const std::string& what, const std::string& with);

/// Writes to standard error. If that is full or closed, the text is lost and nothing fails.
void say(const std::string& text);

} // namespace estampe
