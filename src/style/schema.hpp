// SPDX-License-Identifier: MIT
#pragma once

// The schema of a style: all parameters, where texts are loaded from, and how values are read and written.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// The TOML text of a preset or an addition; none for an unknown name.
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view name);

/// A style text, and its name in error messages.
struct Source {
    std::string name; ///< a path, or "preset pencil"
    std::string text;
};

/// Finds the text for the name of a preset or file. `from` is the Source::name of the text that refers to it,
/// empty for the first text. Throws Error when there is no such text.
using Resolver = std::function<Source(const std::string& name, const std::string& from)>;

/// The default resolver: a preset or addition of that name, otherwise a file, relative to the folder of the
/// file that refers to it. Throws Error listing the presets and additions when neither exists.
[[nodiscard]] Source resolve(const std::string& preset_or_file, const std::string& from);

/// The offset of a member in the values of a schema, whose type is unknown here.
struct Place {
    size_t offset_bytes = 0;

    [[nodiscard]] void* in(void* values) const { return static_cast<std::byte*>(values) + offset_bytes; }

    [[nodiscard]] const void* in(const void* values) const
    {
        return static_cast<const std::byte*>(values) + offset_bytes;
    }
};

/// The parameters of one struct; `place` finds that struct in the values, for Parameter::get and
/// Parameter::set.
struct Section {
    std::string name;
    std::string help;
    std::span<const Parameter> parameters;
    Place place;
};

/// The part of a schema that does not depend on the type of its values: the manual, and reading and writing
/// texts.
class AnySchema {
public:
    /// Returns the manual: one paragraph per section, one line per parameter, with key, type, range, default
    /// and help in columns. `section` is the name of one section, or empty for all sections. Throws Error
    /// with the nearest name when there is no such section.
    [[nodiscard]] std::string help(std::string_view section = {}) const;

    /// A JSON schema (draft 2020-12) of the TOML file, for editors.
    [[nodiscard]] std::string json_schema() const;

    [[nodiscard]] std::span<const Section> sections() const { return sections_; }

    struct Found {
        const Section* section = nullptr; ///< null for an unknown key
        const Parameter* parameter = nullptr;
    };

    /// Finds the parameter of a full key such as "hatch.width_mm". Cost: logarithmic in the number of
    /// parameters.
    [[nodiscard]] Found find(std::string_view key) const;

    /// Returns whether a section or a table in a section has that name: "contour", "contour.outline". Cost:
    /// as find().
    [[nodiscard]] bool has_table(std::string_view name) const;

protected:
    void add(Section section);
    void read_any(void* values, const Source& source, const Resolver& resolver) const;
    void set_any(void* values, std::string_view assignment, const std::string& where) const;
    void apply_any(void* values, const Override& change) const;
    [[nodiscard]] std::string write_any(const void* values) const;

    std::optional<Place> overrides_; ///< where the values store overrides for single surfaces; none:
                                     ///< overrides are not supported

private:
    std::vector<Section> sections_;
    std::map<std::string, std::pair<size_t, size_t>, std::less<>> index_; ///< section and parameter by key
};

/// All parameters of a style, each described once. The methods read and write objects of type `Values`.
///
///     const style::Schema<StyleTables>& style_schema()
///     {
///         static const auto schema = style::Schema<StyleTables>()
///             .section(hatch_table(), &StyleTables::hatch)
///             .section(contour_table(), &StyleTables::contour);
///         return schema;
///     }
///
///     StyleTables tables;
///     style_schema().read(tables, "pencil");
///     style_schema().set(tables, "hatch.width_mm=0.5");
///
/// Errors name the key, what is allowed, and where (file:line:column, or --set), and suggest the nearest
/// known name. A read that fails changes nothing. Tables must outlive the schema.
template <typename Values>
class Schema : public AnySchema {
public:
    Schema() = default;

    /// Creates the schema of a single table, whose struct is the whole of the values.
    explicit Schema(const Table<Values>& table) { add({table.section(), table.help(), table.parameters()}); }

    template <typename Style>
    Schema& section(const Table<Style>& table, Style Values::*member)
    {
        add({table.section(), table.help(), table.parameters(), place_of(member)});
        return *this;
    }

    /// Sets the member that stores overrides for single surfaces. Without it, overrides in a text are an
    /// error.
    Schema& overrides(std::vector<Override> Values::*member)
    {
        overrides_ = place_of(member);
        return *this;
    }

    /// Reads a preset or a TOML file, which has one table per section. The values of `extends = "preset or
    /// file"` are applied before those of the text.
    void read(Values& values, const std::string& preset_or_file, const Resolver& resolver = resolve) const
    {
        read_any(&values, resolver(preset_or_file, {}), resolver);
    }

    /// Reads a TOML text. Error messages refer to it as `where`.
    void read_text(Values& values, std::string_view text, const std::string& where,
                   const Resolver& resolver = resolve) const
    {
        read_any(&values, {where, std::string(text)}, resolver);
    }

    /// Applies "hatch.width_mm=0.5" or "material.brick*.hatch.width_mm=0.5". The value has TOML syntax, but
    /// names and colours need no quotes.
    void set(Values& values, std::string_view assignment, const std::string& where = "--set") const
    {
        set_any(&values, assignment, where);
    }

    /// Sets the parameter to the value of the override.
    void apply(Values& values, const Override& change) const { apply_any(&values, change); }

    /// Writes every parameter with its value, as a TOML text that reads back to equal values.
    [[nodiscard]] std::string to_toml(const Values& values) const { return write_any(&values); }

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
