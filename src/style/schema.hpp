// SPDX-License-Identifier: MIT
#pragma once

// All parameters of a style, described once: where texts come from, and how values are read and written.

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

/// Names of the presets built in: the files presets/*.toml of the source tree, in alphabetical order.
[[nodiscard]] std::vector<std::string> preset_names();

/// Names of the additions built in, which are put behind a preset with '+': the files
/// presets/additions/*.toml, in alphabetical order.
[[nodiscard]] std::vector<std::string> addition_names();

/// The parts of a style's name that '+' joins, as in "comic+no-color", from left to right. A '+' in the name
/// of an existing file joins nothing. Throws Error if a part is empty.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& style_name);

/// The TOML text of a preset or an addition; nothing when there is none of that name.
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view name);

/// A style text and the name that errors give it.
struct Source {
    std::string name; ///< a path, or "preset pencil"
    std::string text;
};

/// Finds the text behind a name: a preset or a file. `from` is the Source::name of the text that names it,
/// empty for the first. Throws Error when there is none.
using Resolver = std::function<Source(const std::string& name, const std::string& from)>;

/// The usual resolver: a preset or addition of that name, else a file, looked up from the folder of the file
/// that names it. Throws Error listing the presets and additions when there is neither.
[[nodiscard]] Source resolve(const std::string& preset_or_file, const std::string& from);

/// Where a member lies in the values of a schema, whose type is not known here.
struct Place {
    size_t offset_bytes = 0;

    [[nodiscard]] void* in(void* values) const { return static_cast<std::byte*>(values) + offset_bytes; }

    [[nodiscard]] const void* in(const void* values) const
    {
        return static_cast<const std::byte*>(values) + offset_bytes;
    }
};

/// The parameters of one struct, which `place` finds in the values for Parameter::get and Parameter::set.
struct Section {
    std::string name;
    std::string help;
    std::span<const Parameter> parameters;
    Place place;
};

/// What a schema knows without the type of its values: the manual, and how texts are read and written.
class AnySchema {
public:
    /// The manual: a paragraph a section, a line a parameter with key, type, range, default and help in
    /// columns. `section` is the name of one section; empty for all. Throws Error, naming the nearest, if
    /// there is no such section.
    [[nodiscard]] std::string help(std::string_view section = {}) const;

    /// A JSON schema (draft 2020-12) of the TOML file, for editors.
    [[nodiscard]] std::string json_schema() const;

    [[nodiscard]] std::span<const Section> sections() const { return sections_; }

    struct Found {
        const Section* section = nullptr; ///< null: there is no such key
        const Parameter* parameter = nullptr;
    };

    /// The parameter of a full key, "hatch.width_mm". Cost: logarithmic in the parameters.
    [[nodiscard]] Found find(std::string_view key) const;

    /// Whether keys stand in a table of that name: "contour", "contour.outline". Cost as that of find().
    [[nodiscard]] bool has_table(std::string_view name) const;

protected:
    void add(Section section);
    void read_any(void* values, const Source& source, const Resolver& resolver) const;
    void set_any(void* values, std::string_view assignment, const std::string& where) const;
    void apply_any(void* values, const Override& change) const;
    [[nodiscard]] std::string write_any(const void* values) const;

    std::optional<Place> overrides_; ///< of what single surfaces have otherwise; empty: nothing differs

private:
    std::vector<Section> sections_;
    std::map<std::string, std::pair<size_t, size_t>, std::less<>> index_; ///< section and parameter by key
};

/// All parameters of a style, described once; its methods read and write any number of `Values`.
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

    /// Of a single table, whose struct is all of the values.
    explicit Schema(const Table<Values>& table) { add({table.section(), table.help(), table.parameters()}); }

    template <typename Style>
    Schema& section(const Table<Style>& table, Style Values::*member)
    {
        add({table.section(), table.help(), table.parameters(), place_of(member)});
        return *this;
    }

    /// What single surfaces have otherwise is kept there; without it a text that says so is in error.
    Schema& overrides(std::vector<Override> Values::*member)
    {
        overrides_ = place_of(member);
        return *this;
    }

    /// Reads the preset or the TOML file of that name: one table a section, and `extends = "preset or file"`,
    /// whose values come first.
    void read(Values& values, const std::string& preset_or_file, const Resolver& resolver = resolve) const
    {
        read_any(&values, resolver(preset_or_file, {}), resolver);
    }

    /// Reads a TOML text; `where` names it in errors.
    void read_text(Values& values, std::string_view text, const std::string& where,
                   const Resolver& resolver = resolve) const
    {
        read_any(&values, {where, std::string(text)}, resolver);
    }

    /// Applies "hatch.width_mm=0.5" or "material.brick*.hatch.width_mm=0.5". The value is written as in TOML,
    /// but names and colours need no quotes.
    void set(Values& values, std::string_view assignment, const std::string& where = "--set") const
    {
        set_any(&values, assignment, where);
    }

    /// Gives the parameter the value that single surfaces have.
    void apply(Values& values, const Override& change) const { apply_any(&values, change); }

    /// Every parameter with its value, as a TOML text that reads back to equal values.
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
