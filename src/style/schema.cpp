// SPDX-License-Identifier: MIT
#include "style/schema.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/read_scope.hpp"
#include "core/text.hpp"
#include "style/material_kind.hpp"
#include "style/names.hpp"
#include "style/toml.hpp"

namespace estampe::style {
namespace {

constexpr std::string_view preset_prefix = "preset ";

bool looks_like_a_file(const std::string& name)
{
    return name.find('/') != std::string::npos || name.ends_with(".toml");
}

[[noreturn]] void fail_unknown(const std::string& name)
{
    std::vector<std::string> names = preset_names();
    const std::vector<std::string> additions = addition_names();
    const std::string known =
        fmt::format("presets are {}; additions are {}", fmt::join(names, ", "), fmt::join(additions, ", "));
    names.insert(names.end(), additions.begin(), additions.end());
    const std::string meant = nearest(name, names);
    throw Error(fmt::format("no preset or style file {}", in_quotes(name)), {},
                meant.empty() ? known : fmt::format("did you mean {}?", in_quotes(meant)));
}

/// Reads a style file. Throws Error with the file's name when it is missing, a folder, unreadable or larger
/// than 1 MiB.
Source load_source(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes, scope);
    std::string text(bytes.size(), '\0');
    std::memcpy(text.data(), bytes.data(), bytes.size());
    return {path.string(), std::move(text)};
}

bool is_file(const std::string& name)
{
    std::error_code problem;
    return std::filesystem::is_regular_file(name, problem);
}

} // namespace

std::vector<std::string> parts_of(const std::string& style_name)
{
    std::vector<std::string> parts;
    size_t begin = 0;
    while (begin <= style_name.size()) {
        // Splits a style's name at '+'. A part of a style's name is the longest prefix that is an existing
        // file. If no prefix is a file, the part is the text up to the next '+'.
        size_t end = style_name.size();
        while (end != std::string::npos && end > begin && !is_file(style_name.substr(begin, end - begin))) {
            end = style_name.rfind('+', end - 1);
        }
        if (end == std::string::npos || end <= begin) {
            end = std::min(style_name.find('+', begin), style_name.size());
        }
        parts.push_back(style_name.substr(begin, end - begin));
        begin = end + 1;
    }
    if (parts.size() > 1 && std::ranges::find(parts, "") != parts.end()) {
        throw Error(fmt::format("a part of the style {} is empty", in_quotes(style_name)), {},
                    "write names with a + between two, such as comic+no-color");
    }
    return parts;
}

Source resolve(const std::string& preset_or_file, const std::string& from, const ReadScope& scope)
{
    if (const auto text = preset_text(preset_or_file)) {
        return {std::string(preset_prefix) + preset_or_file, std::string(*text)};
    }
    std::filesystem::path path = preset_or_file;
    if (!from.empty() && !from.starts_with(preset_prefix)) {
        require_inside(preset_or_file, scope, preset_or_file);
        path = std::filesystem::path(from).parent_path() / path;
        // The folders of a scope are compared as they are written. Within a scope, names have no ".." anyway.
        path = scope.is_limited() ? path : path.lexically_normal();
    }
    std::error_code problem;
    if (!looks_like_a_file(preset_or_file) && !std::filesystem::exists(path, problem)) {
        fail_unknown(preset_or_file);
    }
    return load_source(path, scope);
}

Resolver resolver_within(const ReadScope& scope)
{
    return [scope](const std::string& name, const std::string& from) { return resolve(name, from, scope); };
}

namespace {

constexpr const char* manual = "estampe --help-style all lists every key";

std::string full_key(const Section& section, const Parameter& parameter)
{
    return section.name + "." + parameter.key;
}

/// Resolves `path` relative to the folder of the style file named `source`.
std::string beside(const std::string& source, const std::string& path)
{
    const std::filesystem::path folder = std::filesystem::path(source).parent_path();
    return path.empty() || folder.empty() ? path : (folder / path).string();
}

/// A new value of a parameter, checked but not written to its struct yet.
struct Change {
    AnySchema::Found found;
    Value value;
};

/// Adds an override and removes an earlier override of the same parameter and surfaces.
void append(std::vector<Override>& overrides, const Override& change)
{
    std::erase_if(overrides, [&](const Override& before) {
        return before.surfaces == change.surfaces && before.section == change.section &&
               before.key == change.key;
    });
    overrides.push_back(change);
}

/// An error whose message shows no content of a style's text, apart from names of files in `extends`.
class UnquotedError : public Error {
public:
    using Error::Error;
};

/// Turns the entries of style texts into changes of parameters, and reports all errors of the texts.
class Reader {
public:
    Reader(const AnySchema& schema, std::optional<Place> overrides_place, Resolver resolver,
           const ReadScope& scope)
        : schema_(schema), overrides_place_(overrides_place), resolver_(std::move(resolver)), scope_(scope)
    {
    }

    void read(const Source& source)
    {
        const Document document = parse_toml(source.text, source.name);
        chain_.push_back(source.name);
        for (const Document::Header& header : document.sections) {
            require_section(header);
        }
        for (const Entry& entry : document.entries) {
            if (entry.section.empty() && entry.key == "extends") {
                extend(entry);
            }
        }
        for (const Entry& entry : document.entries) {
            if (!entry.section.empty() || entry.key != "extends") {
                assign(entry);
            }
        }
        chain_.pop_back();
    }

    void assign(const Entry& entry)
    {
        const auto [section, parameter] = find(entry.section, entry.key, entry.key_where);
        Value value = check(*parameter, full_key(*section, *parameter), entry.raw, entry.value_where);
        if (parameter->kind == Kind::file && !chain_.empty()) {
            const auto& text = std::get<std::string>(value);
            const bool is_name = std::ranges::find(parameter->choices, text) != parameter->choices.end();
            if (!is_name) {
                require_inside(text, scope_, entry.value_where);
            }
            value = is_name ? text : beside(chain_.back(), text);
        }
        if (entry.surfaces.by == Surfaces::By::all) {
            changes_.push_back({{section, parameter}, std::move(value)});
            return;
        }
        if (parameter->overridable == Overridable::nowhere) {
            throw Error(
                fmt::format("{} is the same all over the picture", in_quotes(full_key(*section, *parameter))),
                entry.key_where, fmt::format("put it below a line [{}]", section->name));
        }
        if (parameter->overridable == Overridable::by_object && entry.surfaces.by == Surfaces::By::material) {
            throw Error(
                fmt::format("{} cannot differ by material", in_quotes(full_key(*section, *parameter))),
                entry.key_where,
                fmt::format("name an object: put it below a line [object.\"NAME\".{}]", section->name));
        }
        require_kind(entry);
        overrides_.push_back({entry.surfaces, section->name, parameter->key, std::move(value)});
    }

    /// Throws Error if the entry is for a kind of material that is not known.
    static void require_kind(const Entry& entry)
    {
        const auto kind =
            entry.surfaces.by == Surfaces::By::material ? named_kind(entry.surfaces.pattern) : std::nullopt;
        if (kind && std::ranges::find(material_kinds, *kind) == material_kinds.end()) {
            throw Error(fmt::format("unknown kind of material {}", in_quotes(std::string(*kind))),
                        entry.key_where, fmt::format("kinds are {}", fmt::join(material_kinds, ", ")));
        }
    }

    void require_section(const Document::Header& header) const
    {
        const bool is_allowed = header.surfaces.by == Surfaces::By::all || overrides_place_;
        if (is_allowed && schema_.has_table(header.name)) {
            return;
        }
        if (const AnySchema::Found found = schema_.find(header.name); found.parameter != nullptr) {
            std::ignore = check(*found.parameter, header.name, {{}, "a table"}, header.where);
        }
        std::vector<std::string> names;
        for (const Section& section : schema_.sections()) {
            names.push_back(section.name);
        }
        if (!is_allowed) {
            throw Error("nothing here differs from surface to surface", header.where,
                        fmt::format("sections are {}", fmt::join(names, ", ")));
        }
        if (overrides_place_ && header.surfaces.by == Surfaces::By::all) {
            names.insert(names.end(), {"material", "object"});
        }
        std::vector<std::string> tables = names;
        for (const Section& section : schema_.sections()) {
            for (const Parameter& parameter : section.parameters) {
                if (const size_t dot = parameter.key.find('.'); dot != std::string::npos) {
                    tables.push_back(fmt::format("{}.{}", section.name, parameter.key.substr(0, dot)));
                }
            }
        }
        const std::string meant = nearest(header.name, tables);
        throw Error(fmt::format("unknown section {}", in_quotes(header.name)), header.where,
                    meant.empty() ? fmt::format("sections are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean {}?", in_quotes(meant)));
    }

    [[nodiscard]] AnySchema::Found find(const std::string& section_name, const std::string& key,
                                        const std::string& where) const
    {
        const AnySchema::Found found = schema_.find(section_name + "." + key);
        if (found.parameter == nullptr) {
            unknown(section_name, key, where);
        }
        return found;
    }

    /// Writes the changes to the parameters; call this only after all texts were read without error.
    void apply(void* values) const
    {
        for (const Change& change : changes_) {
            change.found.parameter->set(change.found.section->place.in(values), change.value);
        }
        for (const Override& change : overrides_) {
            append(*static_cast<std::vector<Override>*>(overrides_place_->in(values)), change);
        }
    }

private:
    [[noreturn]] void unknown(const std::string& section_name, const std::string& key,
                              const std::string& where) const
    {
        const std::string name = section_name.empty() ? key : section_name + "." + key;
        if (schema_.has_table(name)) {
            throw Error(fmt::format("{} is a section, not a key", in_quotes(name)), where,
                        fmt::format("put its keys below a line [{}]", name));
        }
        if (const std::string_view advice = advice_for(name); !advice.empty()) {
            throw Error(fmt::format("{} is no longer a key", in_quotes(name)), where, std::string(advice));
        }
        const std::string meant = suggestion(name, key);
        throw Error(fmt::format("unknown key {}", in_quotes(name)), where,
                    meant.empty() ? manual : fmt::format("did you mean {}?", in_quotes(meant)));
    }

    /// Suggests a key for an unknown name: first the present key of a former name or of another program's
    /// name, then the same key in another section, then a key with similar spelling.
    [[nodiscard]] std::string suggestion(const std::string& name, const std::string& key) const
    {
        std::vector<std::string> names;
        std::vector<std::string> misplaced;
        for (const Section& section : schema_.sections()) {
            for (const Parameter& parameter : section.parameters) {
                names.push_back(full_key(section, parameter));
                if (parameter.key == key) {
                    misplaced.push_back(names.back());
                }
            }
        }
        names.emplace_back("extends");
        if (const std::string_view now = name_today(name); schema_.find(now).parameter != nullptr) {
            return std::string(now);
        }
        if (misplaced.size() == 1) {
            return misplaced.front();
        }
        if (std::string near = nearest(name, names); !near.empty()) {
            return near;
        }
        return misplaced.empty() ? std::string() : misplaced.front();
    }

    void extend(const Entry& entry)
    {
        constexpr size_t deepest = 16;
        const auto* name = std::get_if<std::string>(&entry.raw.value);
        if (name == nullptr || name->empty()) {
            throw Error(fmt::format("extends = {} is not a name", entry.raw.shown), entry.value_where,
                        "write the name of a preset or a style file in quotes");
        }
        Source base;
        try {
            base = resolver_(*name, chain_.back());
        } catch (const OutsideScope& problem) {
            throw OutsideScope(problem.what(), entry.value_where);
        } catch (const Error& problem) {
            throw Error(problem.what(), entry.value_where);
        }
        if (std::find(chain_.begin(), chain_.end(), base.name) != chain_.end()) {
            throw UnquotedError(
                fmt::format("extends goes in a circle: {} -> {}", fmt::join(chain_, " -> "), base.name),
                entry.value_where, "remove one extends line");
        }
        if (chain_.size() >= deepest) {
            throw UnquotedError(fmt::format("is the {}th style of a chain of extends; {} are the most",
                                            chain_.size() + 1, deepest),
                                entry.value_where, "let it extend a style nearer to the end of the chain");
        }
        read_base(base, entry);
    }

    /// Reads a style that another one extends. Its file may be anything, such as a file with passwords, so
    /// messages do not quote it.
    void read_base(const Source& base, const Entry& entry)
    {
        try {
            read(base);
        } catch (const OutsideScope&) {
            throw;
        } catch (const UnquotedError&) {
            throw;
        } catch (const Error& problem) {
            throw UnquotedError("is no style that can be extended", problem.where(),
                                fmt::format("mend it there, or leave out extends at {}", entry.value_where));
        }
    }

    const AnySchema& schema_;
    std::optional<Place> overrides_place_;
    Resolver resolver_;
    const ReadScope& scope_;
    /// Names of the style texts that are being read, each extended by the one before it. The list is used to
    /// detect cycles.
    std::vector<std::string> chain_;
    std::vector<Change> changes_;
    std::vector<Override> overrides_;
};

/// Splits a parameter's name: "section.key", "material.pattern.section.key" or "object.pattern.section.key".
/// The pattern may be in quotes, and may contain dots.
Entry named_entry(const AnySchema& schema, std::string_view name, const std::string& where)
{
    Entry entry;
    entry.key_where = where;
    for (const auto& [word, by] : {std::pair(std::string_view("material."), Surfaces::By::material),
                                   std::pair(std::string_view("object."), Surfaces::By::object)}) {
        const size_t last = name.rfind('.');
        size_t before = last == std::string_view::npos ? last : name.rfind('.', last - 1);
        const size_t earlier = before == std::string_view::npos ? before : name.rfind('.', before - 1);
        if (earlier != std::string_view::npos && schema.find(name.substr(earlier + 1)).parameter != nullptr) {
            // The part before the key names a table of a section, such as "contour.outline.width_mm".
            before = earlier;
        }
        if (name.starts_with(word) && before != std::string_view::npos && before > word.size()) {
            std::string_view pattern = name.substr(word.size(), before - word.size());
            if (pattern.size() > 1 && pattern.front() == '"' && pattern.back() == '"') {
                pattern = pattern.substr(1, pattern.size() - 2);
            }
            entry.surfaces = {by, std::string(pattern)};
            name.remove_prefix(before + 1);
        }
    }
    const size_t dot = name.find('.');
    const bool has_section = dot != std::string_view::npos;
    entry.section = has_section ? name.substr(0, dot) : std::string_view();
    entry.key = has_section ? name.substr(dot + 1) : name;
    return entry;
}

} // namespace

void AnySchema::add(Section section)
{
    for (size_t i = 0; i < section.parameters.size(); ++i) {
        const Parameter& parameter = section.parameters[i];
        [[maybe_unused]] const Value& value = parameter.default_value;
        if (parameter.kind == Kind::number) {
            assert(std::get<float>(value) >= parameter.range.minimum);
            assert(std::get<float>(value) <= parameter.range.maximum);
        } else if (parameter.kind == Kind::integer) {
            assert(std::get<int64_t>(value) >= parameter.integers.minimum);
            assert(std::get<int64_t>(value) <= parameter.integers.maximum);
        } else if (parameter.kind == Kind::choice) {
            assert(!std::get<std::string>(value).empty());
        }
        index_.emplace(full_key(section, parameter), std::pair(sections_.size(), i));
    }
    sections_.push_back(std::move(section));
}

AnySchema::Found AnySchema::find(std::string_view key) const
{
    const auto place = index_.find(key);
    if (place == index_.end()) {
        return {};
    }
    const Section& section = sections_[place->second.first];
    return {&section, &section.parameters[place->second.second]};
}

bool AnySchema::has_table(std::string_view name) const
{
    const std::string first = std::string(name) + '.';
    const auto next = index_.lower_bound(first);
    return next != index_.end() && next->first.starts_with(first);
}

void AnySchema::read_any(void* values, const Source& source, const Resolver& resolver,
                         const ReadScope& scope) const
{
    Reader reader(*this, overrides_, resolver, scope);
    reader.read(source);
    reader.apply(values);
}

void AnySchema::set_any(void* values, std::string_view assignment, const std::string& where) const
{
    const size_t equals = assignment.find('=');
    const std::string_view name = trimmed(assignment.substr(0, equals));
    if (equals == std::string_view::npos || name.empty()) {
        throw Error(fmt::format("{} is not an assignment", in_quotes(assignment)), where,
                    "write section.key=value, such as hatch.width_mm=0.5");
    }
    Entry entry = named_entry(*this, name, where);
    entry.value_where = where;

    const ReadScope no_limit; // the user may name any file
    Reader reader(*this, overrides_, resolver_within({}), no_limit);
    const Parameter& parameter = *reader.find(entry.section, entry.key, where).parameter;
    const std::string_view value = trimmed(assignment.substr(equals + 1));
    const bool one_line = value.find_first_of("\r\n") == std::string_view::npos;
    const std::optional<Raw> parsed = one_line ? parse_toml_value(value) : std::nullopt;
    entry.raw = parsed && !value.starts_with('#') ? *parsed : raw_word(value);
    const bool is_word =
        parameter.kind == Kind::choice || parameter.kind == Kind::text || parameter.kind == Kind::file;
    if (is_word && !value.starts_with('"') && !value.starts_with('\'')) {
        entry.raw = raw_word(value);
    }
    if (entry.surfaces.by != Surfaces::By::all) {
        reader.require_section({entry.surfaces, entry.section, where});
    }
    reader.assign(entry);
    reader.apply(values);
}

void AnySchema::apply_any(void* values, const Override& change) const
{
    if (const Found found = find(change.section + "." + change.key); found.parameter != nullptr) {
        found.parameter->set(found.section->place.in(values), change.value);
    }
}

} // namespace estampe::style
