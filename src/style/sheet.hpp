// SPDX-License-Identifier: MIT
#pragma once

// The parameters of a style together: where texts of it come from, and all that is read and written.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "style/parameter.hpp"

namespace estampe::style {

/// Names of the presets built in: the files presets/*.toml of the source tree, in alphabetical order.
[[nodiscard]] std::vector<std::string> preset_names();

/// The TOML text of a preset; nothing when there is none of that name.
[[nodiscard]] std::optional<std::string_view> preset_text(std::string_view name);

/// A style text and the name that errors give it.
struct Source {
    std::string name; ///< a path, or "preset pencil"
    std::string text;
};

/// Finds the text behind a name: a preset or a file. `from` is the Source::name of the text that names it,
/// empty for the first. Throws Error when there is none.
using Resolver = std::function<Source(const std::string& name, const std::string& from)>;

/// The usual resolver: a preset of that name, else a file, looked up from the folder of the file that names
/// it. Throws Error listing the presets when there is neither.
[[nodiscard]] Source resolve(const std::string& preset_or_file, const std::string& from);

/// All parameters of a style: tables bound to the structs that hold the values. The readers and writers of a
/// style are its methods. The structs must outlive the sheet; sheets are cheap enough to make for one call.
///
///     Sheet sheet;
///     sheet.bind(hatch_table(), tables.hatch);
///     sheet.bind(contour_table(), tables.contour);
///     sheet.read("pencil");
///     sheet.set("hatch.width_mm=0.5");
///
/// Errors name the key, what is allowed, and where (file:line:column, or --set), and suggest the nearest
/// known name. A read that fails changes nothing.
class Sheet {
public:
    template <typename Style>
    void bind(const Table<Style>& table, Style& values)
    {
        add({table.section(), table.help(), table.parameters(), &values});
    }

    /// What single surfaces have otherwise goes there, which must outlive the sheet too; without it a text
    /// that says so is in error.
    void bind_overrides(std::vector<Override>& overrides) { overrides_ = &overrides; }

    /// Reads the preset or the file of that name.
    void read(const std::string& preset_or_file, const Resolver& resolver = resolve);

    /// Reads a TOML file: one table a section, and `extends = "preset or file"`, whose values come first.
    void read_toml_file(const std::filesystem::path& path, const Resolver& resolver = resolve);

    /// Reads a TOML text; `where` names it in errors.
    void read_toml_text(std::string_view text, const std::string& where, const Resolver& resolver = resolve);

    /// Applies "hatch.width_mm=0.5" or "material.brick*.hatch.width_mm=0.5". The value is written as in TOML,
    /// but names and colours need no quotes.
    void set(std::string_view assignment, const std::string& where = "--set");

    /// Every parameter with its value, as a TOML text that reads back to equal values.
    [[nodiscard]] std::string to_toml() const;

    /// The manual: a paragraph a section, a line a parameter with key, type, range, default and help in
    /// columns.
    [[nodiscard]] std::string help() const;

    /// A JSON schema (draft 2020-12) of the TOML file, for editors.
    [[nodiscard]] std::string json_schema() const;

    struct Section {
        std::string name;
        std::string help;
        std::span<const Parameter> parameters;
        void* values = nullptr;
    };

    [[nodiscard]] std::span<const Section> sections() const { return sections_; }

    /// Gives the parameter the value that single surfaces have.
    void apply(const Override& change) const;

private:
    void add(Section section);

    std::vector<Section> sections_;
    std::vector<Override>* overrides_ = nullptr;
};

} // namespace estampe::style
