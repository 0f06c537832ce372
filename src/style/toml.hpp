// SPDX-License-Identifier: MIT
#pragma once

// Reads the values of a TOML text, and checks each value against its parameter.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "style/parameter.hpp"

namespace estampe::style {

/// A value as read from a style text, before it is checked against its parameter.
struct Raw {
    std::variant<std::monostate, bool, int64_t, double, std::string, std::vector<double>> value;
    std::string shown; ///< the value as error messages show it: `0.5`, `"uv"`, `a table`
};

/// One key of a style text with its value. `section` is empty for a value outside any section.
struct Entry {
    Surfaces surfaces;
    std::string section;
    std::string key;
    Raw raw;
    std::string key_where;   ///< place of the key, as file:line:column
    std::string value_where; ///< place of the value, as file:line:column
};

/// A TOML text in the order of its lines. `sections` lists every table, including empty ones.
struct Document {
    struct Header {
        Surfaces surfaces;
        std::string name;
        std::string where;
    };

    std::vector<Header> sections;
    std::vector<Entry> entries;
};

/// Parses a TOML text. The tables `material` and `object` contain patterns, and each pattern contains
/// sections. Throws Error with name:line:column when the text is not TOML, or has a key twice.
[[nodiscard]] Document parse_toml(std::string_view text, const std::string& name);

/// Parses `text` as a TOML value; returns nothing if `text` is not a value.
[[nodiscard]] std::optional<Raw> parse_toml_value(std::string_view text);

/// Makes a value from a word without quotes. The option --set accepts words without quotes for names and
/// colours.
[[nodiscard]] Raw raw_word(std::string_view text);

/// Converts the value `raw` to a value of `parameter`, which messages call `name`. Throws Error when the type
/// is wrong or the value is out of range.
[[nodiscard]] Value check(const Parameter& parameter, const std::string& name, const Raw& raw,
                          const std::string& where);

/// Describes a parameter's allowed values in words: "0.02 to 10 mm", "1 to 6", "true or false", "#rrggbb",
/// "auto, uv".
[[nodiscard]] std::string allowed(const Parameter& parameter);

/// Formats a value as TOML text: 0.35, 3, true, "#1b1a22", "auto".
[[nodiscard]] std::string format_value(const Value& value);

/// Puts `text` in double quotes, escapes control characters, and shortens a long text, for use in one line of
/// a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

struct WordEntry {
    std::string key;
    /// Values as words: numbers as written in the text, switches as "true" and "false".
    std::vector<std::string> words;
    bool is_list = false;
    bool is_switch = false;
    std::string where; ///< place of the entry, as file:line:column
};

struct WordTable {
    std::string name;
    std::string where;
    std::vector<WordEntry> entries; ///< entries of the table, in the order of the text
};

/// Reads the tables of a TOML text, `[name]` and `[[name]]`, in the order of the text. Throws Error with
/// name:line:column when the text is not TOML, and if it has tables or values that are not words.
[[nodiscard]] std::vector<WordTable> parse_toml_words(std::string_view text, const std::string& name);

} // namespace estampe::style
