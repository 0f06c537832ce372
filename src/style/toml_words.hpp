// SPDX-License-Identifier: MIT
#pragma once

// TOML that stands for command lines: tables of keys whose values are words, as they would be typed.

#include <string>
#include <string_view>
#include <vector>

namespace estampe::style {

struct WordEntry {
    std::string key;
    std::vector<std::string> words; ///< numbers as they are written, switches as "true" and "false"
    bool is_list = false;
    bool is_switch = false;
    std::string where; ///< file:line:column
};

struct WordTable {
    std::string name;
    std::string where;
    std::vector<WordEntry> entries; ///< in the order of the text
};

/// Reads tables, `[name]` and `[[name]]`, in the order of the text. Throws Error with name:line:column for
/// what is not TOML, and for what is no such table or word.
[[nodiscard]] std::vector<WordTable> parse_toml_words(std::string_view text, const std::string& name);

} // namespace estampe::style
