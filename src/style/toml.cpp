// SPDX-License-Identifier: MIT
#include "style/toml.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

namespace estampe::style {
namespace {

/// The form of all UTF-8 characters of one length: lead bytes `first` to `last`, code points `least` to
/// `most`.
struct Form {
    uint8_t first, last;
    uint32_t least, most;
};

constexpr std::array<Form, 4> forms{{{0x00, 0x7F, 0x0, 0x7F},
                                     {0xC2, 0xDF, 0x80, 0x7FF},
                                     {0xE0, 0xEF, 0x800, 0xFFFF},
                                     {0xF0, 0xF4, 0x10000, 0x10FFFF}}};

/// Returns the length in bytes of the UTF-8 character at the start of `text`; 0 if no valid character is
/// there.
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

/// Finds the end of the single-line or multi-line string that begins at `at`: the offset just after its
/// quotes. If the string is not terminated, its end is the end of the line, or for a multi-line string the
/// end of the text.
size_t end_of_string(std::string_view text, size_t at)
{
    // The last three quotes close the string; earlier quotes belong to the string.
    constexpr size_t most_closing = 5;
    const char quote = text[at];
    const std::string three(3, quote);
    const bool has_lines = text.substr(at).starts_with(three);
    for (at += has_lines ? three.size() : 1; at < text.size(); ++at) {
        if (text[at] == '\\' && quote == '"') {
            ++at;
        } else if (has_lines && text.substr(at).starts_with(three)) {
            const size_t after = std::min(text.find_first_not_of(quote, at), text.size());
            return std::min(after, at + most_closing);
        } else if (!has_lines && text[at] == quote) {
            return at + 1;
        } else if (!has_lines && text[at] == '\n') {
            return at;
        }
    }
    return text.size();
}

/// Returns the offset of the first byte that does not begin a valid UTF-8 character: a stray or missing byte,
/// an overlong encoding, a surrogate, or a code point beyond U+10FFFF. Returns the size of `text` when all
/// are valid.
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

/// Finds the first non-ASCII character outside of strings and comments, where TOML allows none, or the end of
/// `text`. A byte order mark at the beginning is skipped.
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

/// Thrown when an assertion in toml++ fails. For example, an assertion fails for `[=`, which toml++ reads as
/// a table header without a name.
struct ParserLost : std::exception {};

[[noreturn]] void lose_parser()
{
    throw ParserLost();
}

} // namespace
} // namespace estampe::style

// Keeps toml++'s assertions in release builds, in which toml++ turns them into undefined behaviour by
// default.
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : estampe::style::lose_parser())
// The tables of characters have cases that toml++ 3.3 marks as unreachable, and that a letter such as U+00E9
// within a value does reach. No character of these cases is a space or a letter of a key.
#include <toml++/impl/preprocessor.h>
#pragma push_macro("TOML_UNREACHABLE")
#undef TOML_UNREACHABLE
#define TOML_UNREACHABLE return false
#include <toml++/impl/unicode_autogenerated.h>
#pragma pop_macro("TOML_UNREACHABLE")
#include <toml++/toml.h>

namespace estampe::style {
namespace {

std::string place(const std::string& name, const toml::source_position& position)
{
    return fmt::format("{}:{}:{}", name, position.line, position.column);
}

std::string place_of_byte(const std::string& name, std::string_view text, size_t at)
{
    toml::source_position position{1, 1};
    for (const char character : text.substr(0, at)) {
        const bool begins_character = (static_cast<unsigned char>(character) & 0xC0U) != 0x80U;
        position.column += begins_character ? 1U : 0U;
        if (character == '\n') {
            ++position.line;
            position.column = 1;
        }
    }
    return place(name, position);
}

/// Rejects characters that toml++ handles wrongly. toml++ uses code points as table indices without checking
/// for invalid UTF-8, and assumes that non-ASCII characters only occur in strings and comments.
void check_characters(std::string_view text, const std::string& name)
{
    if (const size_t at = first_not_utf8(text); at < text.size()) {
        throw Error(fmt::format("not TOML: byte 0x{:02x} begins no character of UTF-8",
                                static_cast<unsigned char>(text[at])),
                    place_of_byte(name, text, at), "save the file as UTF-8");
    }
    const size_t bare = first_bare_beyond_ascii(text);
    if (bare < text.size()) {
        throw Error("not TOML: a character beyond ASCII outside of quotes", place_of_byte(name, text, bare),
                    "only strings and comments may hold it");
    }
}

/// Returns the numbers of a TOML array, which is a colour; nothing if an element is not a number.
std::optional<std::vector<double>> numbers(const toml::array& array)
{
    std::vector<double> result;
    for (const toml::node& node : array) {
        const std::optional<double> number = node.is_number() ? node.value<double>() : std::nullopt;
        if (!number) {
            return std::nullopt;
        }
        result.push_back(*number);
    }
    return result;
}

Raw raw_from(const toml::node& node)
{
    if (const auto* text = node.as_string()) {
        return raw_word(text->get());
    }
    if (const auto* integer = node.as_integer()) {
        return {integer->get(), fmt::format("{}", integer->get())};
    }
    if (const auto* real = node.as_floating_point()) {
        return {real->get(), fmt::format("{}", real->get())};
    }
    if (const auto* toggle = node.as_boolean()) {
        return {toggle->get(), toggle->get() ? "true" : "false"};
    }
    if (const auto* array = node.as_array()) {
        if (auto parts = numbers(*array); parts && parts->size() <= 4) {
            std::string shown = fmt::format("[{}]", fmt::join(*parts, ", "));
            return {std::move(*parts), std::move(shown)};
        }
        return {{}, "an array"};
    }
    return {{}, node.is_table() ? "a table" : "a date or time"};
}

/// Returns the keys of a table in the order of the text; toml++ itself sorts keys by name.
std::vector<std::pair<const toml::key*, const toml::node*>> in_order(const toml::table& table)
{
    std::vector<std::pair<const toml::key*, const toml::node*>> result;
    for (const auto& [key, node] : table) {
        result.emplace_back(&key, &node);
    }
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.first->source().begin < b.first->source().begin; });
    return result;
}

/// Returns the position of a table header without a name.
toml::source_position nameless_header(std::string_view text)
{
    toml::source_position position{1, 1};
    for (; !text.empty(); ++position.line) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const size_t first = line.find_first_not_of(" \t");
        const size_t name = std::min(line.size(), line.find_first_not_of(" \t["));
        const auto brackets = std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(name), '[');
        const bool named =
            name < line.size() && (std::isalnum(static_cast<unsigned char>(line[name])) != 0 ||
                                   std::string_view("_-\"'").find(line[name]) != std::string_view::npos);
        if (brackets > 2 || (brackets > 0 && !named)) {
            position.column = static_cast<toml::source_index>(first + 1);
            break;
        }
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
    return position;
}

/// Collects the keys and values of a TOML text, whose tables may come in any order.
class Gathering {
public:
    explicit Gathering(std::string name) : name_(std::move(name)) {}

    void add_text(const toml::table& root)
    {
        for (const auto& [key, node] : in_order(root)) {
            const std::string word(key->str());
            const toml::table* table = node->as_table();
            if (table != nullptr && word == "material") {
                add_patterns(*table, Surfaces::By::material);
            } else if (table != nullptr && word == "object") {
                add_patterns(*table, Surfaces::By::object);
            } else if (table != nullptr) {
                add_section({}, *key, *table);
            } else {
                add_entry({}, {}, word, *key, *node);
            }
        }
    }

    /// Returns the collected document with its entries in the order of the text.
    [[nodiscard]] Document take()
    {
        std::ranges::stable_sort(
            entries_, [](const auto& a, const auto& b) { return a < b; },
            [](const auto& placed) { return placed.first; });
        for (auto& [position, entry] : entries_) {
            document_.entries.push_back(std::move(entry));
        }
        return std::move(document_);
    }

private:
    void add_patterns(const toml::table& patterns, Surfaces::By by)
    {
        for (const auto& [pattern, sections] : in_order(patterns)) {
            const Surfaces surfaces{by, std::string(pattern->str())};
            const toml::table* table = sections->as_table();
            if (table == nullptr) {
                fail_bare(surfaces, *pattern);
            }
            for (const auto& [key, node] : in_order(*table)) {
                const toml::table* section = node->as_table();
                if (section == nullptr) {
                    fail_bare(surfaces, *key);
                }
                add_section(surfaces, *key, *section);
            }
        }
    }

    [[noreturn]] void fail_bare(const Surfaces& surfaces, const toml::key& key) const
    {
        const char* kind = surfaces.by == Surfaces::By::material ? "material" : "object";
        throw Error(fmt::format("{} stands in no section", in_quotes(key.str())),
                    place(name_, key.source().begin),
                    fmt::format("put keys below a line such as [{}.\"brick*\".hatch]", kind));
    }

    void add_section(const Surfaces& surfaces, const toml::key& section, const toml::table& table)
    {
        const std::string name(section.str());
        document_.sections.push_back({surfaces, name, place(name_, section.source().begin)});
        for (const auto& [key, node] : in_order(table)) {
            if (const toml::table* inner = node->as_table()) {
                add_table(surfaces, name, *key, *inner);
            } else {
                add_entry(surfaces, name, std::string(key->str()), *key, *node);
            }
        }
    }

    /// Adds a table of a section, such as [contour.outline]: its keys become "outline.width_mm" and so on.
    void add_table(const Surfaces& surfaces, const std::string& section, const toml::key& key,
                   const toml::table& table)
    {
        const std::string name(key.str());
        document_.sections.push_back(
            {surfaces, fmt::format("{}.{}", section, name), place(name_, key.source().begin)});
        for (const auto& [inner, node] : in_order(table)) {
            add_entry(surfaces, section, fmt::format("{}.{}", name, inner->str()), *inner, *node);
        }
    }

    void add_entry(const Surfaces& surfaces, const std::string& section, std::string key_name,
                   const toml::key& key, const toml::node& node)
    {
        entries_.emplace_back(key.source().begin,
                              Entry{surfaces, section, std::move(key_name), raw_from(node),
                                    place(name_, key.source().begin), place(name_, node.source().begin)});
    }

    std::string name_;
    Document document_;
    std::vector<std::pair<toml::source_position, Entry>> entries_;
};

toml::table parsed(std::string_view text, const std::string& name)
{
    check_characters(text, name);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& problem) {
        throw Error(fmt::format("not TOML: {}", problem.description()), place(name, problem.source().begin));
    } catch (const ParserLost&) {
        throw Error("not TOML: a table header without a name", place(name, nameless_header(text)));
    }
}

std::string word_of(const toml::node& node, const std::string& name)
{
    if (const auto* text = node.as_string()) {
        return text->get();
    }
    if (node.is_number() || node.is_boolean()) {
        return raw_from(node).shown;
    }
    throw Error(fmt::format("{} is no word, number or switch", raw_from(node).shown),
                place(name, node.source().begin));
}

WordTable word_table(std::string table_name, const toml::table& table, const std::string& name)
{
    WordTable words{.name = std::move(table_name)};
    for (const auto& [key, node] : in_order(table)) {
        WordEntry entry{.key = std::string(key->str()),
                        .is_list = node->is_array(),
                        .is_switch = node->is_boolean(),
                        .where = place(name, key->source().begin)};
        if (const toml::array* list = node->as_array()) {
            for (const toml::node& item : *list) {
                entry.words.push_back(word_of(item, name));
            }
        } else {
            entry.words.push_back(word_of(*node, name));
        }
        words.entries.push_back(std::move(entry));
    }
    return words;
}

} // namespace

Document parse_toml(std::string_view text, const std::string& name)
{
    Gathering gathering(name);
    gathering.add_text(parsed(text, name));
    return gathering.take();
}

std::vector<WordTable> parse_toml_words(std::string_view text, const std::string& name)
{
    const toml::table root = parsed(text, name);
    std::vector<std::pair<toml::source_position, WordTable>> found;
    const auto add = [&](const toml::key& key, const toml::node& node) {
        const toml::table* table = node.as_table();
        const std::string where = place(name, node.source().begin);
        if (table == nullptr) {
            throw Error(fmt::format("{} stands outside of a table", in_quotes(key.str())),
                        place(name, key.source().begin), "put it below a line such as [name]");
        }
        found.emplace_back(node.source().begin, word_table(std::string(key.str()), *table, name));
        found.back().second.where = where;
    };
    for (const auto& [key, node] : root) {
        const toml::array* list = node.as_array();
        if (list == nullptr || !list->is_array_of_tables()) {
            add(key, node);
            continue;
        }
        for (const toml::node& item : *list) {
            add(key, item);
        }
    }
    std::ranges::stable_sort(found, {},
                             [](const auto& pair) { return std::pair(pair.first.line, pair.first.column); });
    std::vector<WordTable> tables;
    tables.reserve(found.size());
    for (auto& [position, table] : found) {
        tables.push_back(std::move(table));
    }
    return tables;
}

std::optional<Raw> parse_toml_value(std::string_view text)
{
    if (first_not_utf8(text) != text.size() || first_bare_beyond_ascii(text) != text.size()) {
        return std::nullopt;
    }
    try {
        const toml::table root = toml::parse(fmt::format("value = {}", text));
        if (root.size() == 1) {
            return raw_from(*root.get("value"));
        }
    } catch (const toml::parse_error&) {
        return std::nullopt;
    } catch (const ParserLost&) {
        return std::nullopt;
    }
    return std::nullopt;
}

Raw raw_word(std::string_view text)
{
    return {std::string(text), in_quotes(text)};
}

} // namespace estampe::style
