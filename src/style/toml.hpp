// SPDX-License-Identifier: MIT
#pragma once

// Values as a TOML text has them, read and checked against a parameter.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "style/parameter.hpp"

namespace estampe::style {

/// A value as a text gives it, before its parameter has looked at it.
struct Raw {
    std::variant<std::monostate, bool, int64_t, double, std::string, std::vector<double>> value;
    std::string shown; ///< for messages: `0.5`, `"uv"`, `a table`
};

/// One line of a style text. A value outside any section has an empty `section`.
struct Entry {
    Surfaces surfaces;
    std::string section;
    std::string key;
    Raw raw;
    std::string key_where;   ///< file:line:column
    std::string value_where; ///< file:line:column
};

/// A TOML text in the order of its lines. `sections` names every table, the empty ones too.
struct Document {
    struct Header {
        Surfaces surfaces;
        std::string name;
        std::string where;
    };

    std::vector<Header> sections;
    std::vector<Entry> entries;
};

/// Parses a TOML text. Below `material` and `object` stand patterns, and below those sections. Throws Error
/// with name:line:column when it is not TOML, or holds a key twice.
[[nodiscard]] Document parse_toml(std::string_view text, const std::string& name);

/// The value of the TOML expression `text`; nothing when it is not one.
[[nodiscard]] std::optional<Raw> parse_toml_value(std::string_view text);

/// A word without quotes, as --set takes them for names and colours.
[[nodiscard]] Raw raw_word(std::string_view text);

/// `raw` as a value of `parameter`, named `name` in messages. Throws Error when the type is wrong or the
/// range is left.
[[nodiscard]] Value check(const Parameter& parameter, const std::string& name, const Raw& raw,
                          const std::string& where);

/// "0.02 to 10 mm", "1 to 6", "true or false", "#rrggbb", "auto, uv".
[[nodiscard]] std::string allowed(const Parameter& parameter);

/// The TOML text of a value: 0.35, 3, true, "#1b1a22", "auto".
[[nodiscard]] std::string format_value(const Value& value);

/// `text` in double quotes, control characters escaped, cut when it is long: fit for one line of a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

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
