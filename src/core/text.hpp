// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace estampe {

/// `text` on one line: control characters, which could command a terminal, become "\x1b".
[[nodiscard]] std::string one_line(std::string_view text);

/// `text`, or its beginning and its end if it is too long to be read.
[[nodiscard]] std::string shortened(const std::string& text);

/// `text` on one line, in double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// `text` in small letters. Letters beyond ASCII stay as they are: their case depends on a language.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Puts `with` in place of each `what` in `text`, from left to right; what was put in is not searched.
void replace_all(std::string& text, const std::string& what, const std::string& with);

/// Writes to standard error. If that is full or closed, the text is lost and nothing fails.
void say(const std::string& text);

} // namespace estampe
