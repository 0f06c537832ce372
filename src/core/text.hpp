// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace estampe {

/// Returns `text` as one line. Control characters, which could be commands for a terminal, are written as
/// codes such as "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// Returns `text`; if it is too long to read, returns only its beginning and its end.
[[nodiscard]] std::string shortened(const std::string& text);

/// Returns `text` as one line, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Returns `text` in lower case. Non-ASCII letters are unchanged, because their case depends on the language.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Returns `text` without the characters of `around` at its beginning and its end.
[[nodiscard]] std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\n");

/// Parses `text` as a number, as std::from_chars does. Returns nothing if any part of `text` is not part of
/// the number, or if the number does not fit the type.
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

/// Writes `text` to standard error. If standard error is full or closed, the text is lost and nothing fails.
void say(const std::string& text);

} // namespace estampe
