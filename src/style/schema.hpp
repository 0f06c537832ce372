// SPDX-License-Identifier: MIT
#pragma once

// The schema of a style: the list of all parameters, and functions that find, read and write style texts.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <estampe/read_scope.hpp>

#include "style/parameter.hpp"

namespace estampe::style {

/// Names of the built-in presets: the files presets/*.toml of the source tree, in alphabetical order.
[[nodiscard]] std::vector<std::string> preset_names();

/// Names of the built-in additions, which are appended to a preset with '+': the files
/// presets/additions/*.toml, in alphabetical order.
[[nodiscard]] std::vector<std::string> addition_names();

/// Splits a style's name at '+', as in "comic+no-color", from left to right. A '+' within the name of an
/// existing file does not split. Throws Error if a part is empty.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& style_name);

/// Returns the TOML text of a preset or an addition; for "default" a text that sets nothing; nothing for an
/// unknown name.
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view name);

/// A style as TOML text, with the name that error messages use for it.
struct Source {
    std::string name; ///< name of the text in error messages: a path, or "preset pencil"
    std::string text;
};

/// Finds the style text for the name of a preset or file. `from` is the Source::name of the text that names
/// it in `extends`; empty for the first text. Throws Error when no style text has the name.
using Resolver = std::function<Source(const std::string& name, const std::string& from)>;

/// Finds a style text by name: a preset or addition of that name, otherwise a file, relative to the folder of
/// the file that names it. Throws Error listing the presets and additions when neither exists, and Error for
/// a file outside of `scope`.
[[nodiscard]] Source resolve(const std::string& preset_or_file, const std::string& from,
                             const ReadScope& scope = {});

/// The Resolver of style files: resolve() within `scope`.
[[nodiscard]] Resolver resolver_within(const ReadScope& scope);

/// The place of a member in a schema's values, stored as an offset because the type of the values is unknown
/// here.
struct Place {
    size_t offset_bytes = 0;

    [[nodiscard]] void* in(void* values) const { return static_cast<std::byte*>(values) + offset_bytes; }

    [[nodiscard]] const void* in(const void* values) const
    {
        return static_cast<const std::byte*>(values) + offset_bytes;
    }
};

/// A section of a style: the parameters of one struct. `place` finds that struct in the schema's values, for
/// Parameter::get and Parameter::set.
struct Section {
    std::string name;
    std::string help;
    std::span<const Parameter> parameters;
    Place place;
};

/// The part of a style schema that does not depend on the type of its values: the manual, and reading and
/// writing texts.
class AnySchema {
public:
    /// Returns the manual of a style: one paragraph per section, one line per parameter, with key, type,
    /// range, default and help in columns. `section` is the name of one section, or empty for all sections.
    /// Throws Error with the nearest name when the style has no section of the name.
    [[nodiscard]] std::string help(std::string_view section = {}) const;

    /// Returns a JSON schema (draft 2020-12) of style files, for editors.
    [[nodiscard]] std::string json_schema() const;

    [[nodiscard]] std::span<const Section> sections() const { return sections_; }

    struct Found {
        const Section* section = nullptr; ///< section of the key that was found; null for an unknown key
        const Parameter* parameter = nullptr;
    };

    /// Finds a parameter by its full key, such as "hatch.width_mm". Cost: logarithmic in the number of
    /// parameters.
    [[nodiscard]] Found find(std::string_view key) const;

    /// Returns whether a style has a section with that name, such as "contour", or a table in a section, such
    /// as "contour.outline". Cost: logarithmic in the number of parameters.
    [[nodiscard]] bool has_table(std::string_view name) const;

protected:
    void add(Section section);
    void read_any(void* values, const Source& source, const Resolver& resolver, const ReadScope& scope) const;
    void set_any(void* values, std::string_view assignment, const std::string& where) const;
    void apply_any(void* values, const Override& change) const;
    [[nodiscard]] std::string write_any(const void* values) const;
    [[nodiscard]] std::vector<std::filesystem::path> files_of_any(const void* values) const;

    /// Member of the values that stores the overrides for single surfaces; none: overrides are not supported.
    std::optional<Place> overrides_;

private:
    std::vector<Section> sections_;
    /// For each full key: the index of its section, and the index of the parameter in the section.
    std::map<std::string, std::pair<size_t, size_t>, std::less<>> index_;
};

/// All parameters of a style, each described once. The methods read and write objects of type `Values`.
///
/// const style::Schema<StyleTables>& style_schema()
///     {
///         static const auto schema = style::Schema<StyleTables>()
///             .section(hatch_table(), &StyleTables::hatch)
///             .section(contour_table(), &StyleTables::contour);
///         return schema;
///     }
///
/// StyleTables tables;
///     style_schema().read(tables, "pencil");
///     style_schema().set(tables, "hatch.width_mm=0.5");
///
/// Errors name the key, what is allowed, and where (file:line:column, or --set), and suggest the nearest
/// known name. A read that fails changes nothing. Tables must outlive the schema.
template <typename Values>
class Schema : public AnySchema {
public:
    Schema() = default;

    /// Creates the schema of a style that has a single table; the table's struct is the type of the values.
    explicit Schema(const Table<Values>& table) { add({table.section(), table.help(), table.parameters()}); }

    template <typename Style>
    Schema& section(const Table<Style>& table, Style Values::*member)
    {
        add({table.section(), table.help(), table.parameters(), place_of(member)});
        return *this;
    }

    /// Sets the member that stores overrides for single surfaces. Without this member, overrides in a style
    /// text are an error.
    Schema& overrides(std::vector<Override> Values::*member)
    {
        overrides_ = place_of(member);
        return *this;
    }

    /// Reads a preset or a TOML file, which has one table per section. Values of the style named in `extends
    /// = "preset or file"` are applied first, and the text's own values after them. Messages show no content
    /// of a file that is named in `extends`, because the file may be no style at all. Throws Error if a text
    /// names a file outside of `scope`; the files of parameters may then still be links.
    void read(Values& values, const std::string& preset_or_file, const ReadScope& scope = {}) const
    {
        const Resolver resolver = resolver_within(scope);
        read_any(&values, resolver(preset_or_file, {}), resolver, scope);
    }

    /// Reads a style from a TOML text. In error messages, `where` is the name of the text.
    void read_text(Values& values, std::string_view text, const std::string& where,
                   const Resolver& resolver = resolver_within({})) const
    {
        read_any(&values, {where, std::string(text)}, resolver, {});
    }

    /// Applies one assignment, such as "hatch.width_mm=0.5" or "material.brick*.hatch.width_mm=0.5". The
    /// value has TOML syntax, but names and colours need no quotes.
    void set(Values& values, std::string_view assignment, const std::string& where = "--set") const
    {
        set_any(&values, assignment, where);
    }

    /// Sets a parameter to the value of an override.
    void apply(Values& values, const Override& change) const { apply_any(&values, change); }

    /// Writes every parameter with its value, as a TOML text that reads back to equal values.
    [[nodiscard]] std::string to_toml(const Values& values) const { return write_any(&values); }

    /// Returns the files that parameters and overrides name, without texts that are names of a choice.
    [[nodiscard]] std::vector<std::filesystem::path> files(const Values& values) const
    {
        return files_of_any(&values);
    }

private:
    template <typename Member>
    static Place place_of(Member Values::*member)
    {
        const Values values{};
        return {static_cast<size_t>(reinterpret_cast<const std::byte*>(&(values.*member)) -
                                    reinterpret_cast<const std::byte*>(&values))};
    }
};

} // namespace estampe::style
