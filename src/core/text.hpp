// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace estampe {

/// `text` on one line: control characters, which could command a terminal, become "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// `text`, or its beginning and end if it is too long to read.
[[nodiscard]] std::string shortened(const std::string& text);

/// `text` on one line, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// `text` in lower case. Non-ASCII letters are unchanged, because their case depends on the language.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Replaces each `what` in `text` by `with`, from left to right. Replacements are not searched again.
void replace_all(std::string& text, const std::string& what, const std::string& with);

/// Writes to standard error. If that is full or closed, the text is lost and nothing fails.
void say(const std::string& text);

} // namespace estampe
