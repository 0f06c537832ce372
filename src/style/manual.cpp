// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "style/names.hpp"
#include "style/schema.hpp"
#include "style/toml.hpp"

namespace estampe::style {
namespace {

using Json = nlohmann::ordered_json;

/// Removes the quotes around a TOML value, to keep the manual's columns readable.
std::string bare(std::string text)
{
    text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
    return text;
}

std::string range_column(const Parameter& parameter)
{
    switch (parameter.kind) {
    case Kind::color:
        return parameter.choices.empty() ? "#rrggbb, name" : "auto, #rrggbb, name";
    case Kind::text:
        return "text";
    case Kind::file:
        return parameter.choices.empty() ? "file"
                                         : fmt::format("{}, file", fmt::join(parameter.choices, ", "));
    default:
        return allowed(parameter);
    }
}

/// Returns whether TOML writes this choice without quotes, as the words true and false.
bool is_switch(const std::string& choice)
{
    return choice == "true" || choice == "false";
}

/// The TOML text of a parameter's value.
std::string format_value_of(const Parameter& parameter, const Value& value)
{
    const auto* text = std::get_if<std::string>(&value);
    return parameter.kind == Kind::choice && is_switch(*text) ? *text : format_value(value);
}

std::string default_column(const Parameter& parameter)
{
    return bare(format_value(parameter.default_value));
}

/// Converts a float to the short decimal number that a person wrote, such as 0.1, instead of its exact value
/// in double precision.
double decimal(float value)
{
    return std::stod(fmt::format("{}", value));
}

Json describe(const Parameter& parameter)
{
    Json json;
    const std::string unit = parameter.unit.empty() ? "" : fmt::format(" ({})", parameter.unit);
    json["description"] = parameter.help + unit;
    switch (parameter.kind) {
    case Kind::number:
        json["type"] = "number";
        json["minimum"] = decimal(parameter.range.minimum);
        json["maximum"] = decimal(parameter.range.maximum);
        json["default"] = decimal(std::get<float>(parameter.default_value));
        break;
    case Kind::integer:
        json["type"] = "integer";
        json["minimum"] = parameter.integers.minimum;
        json["maximum"] = parameter.integers.maximum;
        json["default"] = std::get<int64_t>(parameter.default_value);
        break;
    case Kind::toggle:
        json["type"] = "boolean";
        json["default"] = std::get<bool>(parameter.default_value);
        break;
    case Kind::color: {
        const Json part = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
        const Json hex = {{"type", "string"}, {"pattern", "^(#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})|[a-zA-Z]+)$"}};
        const Json array = {{"type", "array"}, {"items", part}, {"minItems", 3}, {"maxItems", 3}};
        json["anyOf"] = Json::array({hex, array});
        if (!parameter.choices.empty()) {
            json["anyOf"].push_back({{"enum", parameter.choices}});
        }
        json["default"] = Json::parse(format_value(parameter.default_value));
        break;
    }
    case Kind::text:
    case Kind::file:
        json["type"] = "string";
        json["default"] = std::get<std::string>(parameter.default_value);
        break;
    case Kind::choice:
        for (const std::string& choice : parameter.choices) {
            json["enum"].push_back(is_switch(choice) ? Json(choice == "true") : Json(choice));
        }
        json["default"] = std::get<std::string>(parameter.default_value);
        break;
    }
    return json;
}

/// Adds a key to the JSON schema. A key in a table becomes a nested property: "outline.width_mm" is a
/// property of the object "outline".
void add_key(Json& keys, const std::string& key, Json description)
{
    const size_t dot = key.find('.');
    if (dot == std::string::npos) {
        keys[key] = std::move(description);
        return;
    }
    Json& table = keys[key.substr(0, dot)];
    table["type"] = "object";
    table["properties"][key.substr(dot + 1)] = std::move(description);
    table["additionalProperties"] = false;
}

std::string_view word_of(Surfaces::By by)
{
    return by == Surfaces::By::material ? "material" : "object";
}

/// Describes overrides in the JSON schema: lists the sections with parameters that may differ by object, or
/// by object and material. `least` selects one of the two.
Json describe_overrides(std::span<const Section> sections, Overridable least)
{
    Json properties = Json::object();
    for (const Section& section : sections) {
        Json keys = Json::object();
        for (const Parameter& parameter : section.parameters) {
            if (parameter.overridable >= least) {
                Json description = describe(parameter);
                description.erase("default");
                add_key(keys, parameter.key, std::move(description));
            }
        }
        if (!keys.empty()) {
            properties[section.name] = {{"description", section.help},
                                        {"type", "object"},
                                        {"properties", keys},
                                        {"additionalProperties", false}};
        }
    }
    return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

/// Lists the parameters with this `overridable`, section by section, for the manual.
std::string overrides_help(std::span<const Section> sections, Overridable overridable)
{
    std::string text;
    for (const Section& section : sections) {
        std::vector<std::string> keys;
        for (const Parameter& parameter : section.parameters) {
            if (parameter.overridable == overridable) {
                keys.push_back(parameter.key);
            }
        }
        if (keys.size() == section.parameters.size()) {
            text += fmt::format("  {}: all\n", section.name);
        } else if (!keys.empty()) {
            text += fmt::format("  {}: {}\n", section.name, fmt::join(keys, ", "));
        }
    }
    return text;
}

} // namespace

std::string AnySchema::write_any(const void* values) const
{
    static const std::vector<Override> none;
    const auto& overrides =
        overrides_ ? *static_cast<const std::vector<Override>*>(overrides_->in(values)) : none;
    std::string text;
    // Overrides are written before all sections, because dotted keys must come before the first table of a
    // TOML file.
    for (const Override& change : overrides) {
        text += fmt::format("{}.{}.{}.{} = {}\n", word_of(change.surfaces.by),
                            format_value(change.surfaces.pattern), change.section, change.key,
                            format_value(change.value));
    }
    for (const Section& section : sections_) {
        text += fmt::format("{}# {}\n[{}]\n", text.empty() ? "" : "\n", section.help, section.name);
        for (const Parameter& parameter : section.parameters) {
            text += fmt::format("{} = {}\n", parameter.key,
                                format_value_of(parameter, parameter.get(section.place.in(values))));
        }
    }
    return text;
}

std::vector<std::filesystem::path> AnySchema::files_of_any(const void* values) const
{
    std::vector<std::filesystem::path> files;
    const auto add = [&](const Parameter& parameter, const Value& value) {
        const std::string* const text =
            parameter.kind == Kind::file ? std::get_if<std::string>(&value) : nullptr;
        if (text != nullptr && !text->empty() &&
            std::ranges::find(parameter.choices, *text) == parameter.choices.end()) {
            files.emplace_back(*text);
        }
    };
    for (const Section& section : sections_) {
        for (const Parameter& parameter : section.parameters) {
            add(parameter, parameter.get(section.place.in(values)));
        }
    }
    if (overrides_) {
        for (const Override& change : *static_cast<const std::vector<Override>*>(overrides_->in(values))) {
            const Found found = find(change.section + "." + change.key);
            if (found.parameter != nullptr) {
                add(*found.parameter, change.value);
            }
        }
    }
    return files;
}

std::string AnySchema::help(std::string_view section_name) const
{
    std::vector<Section> wanted;
    std::ranges::copy_if(sections_, std::back_inserter(wanted), [&](const Section& section) {
        return section_name.empty() || section.name == section_name;
    });
    if (wanted.empty()) {
        std::vector<std::string> names;
        std::ranges::transform(sections_, std::back_inserter(names), &Section::name);
        const std::string meant = nearest(section_name, names);
        throw Error(fmt::format("no section {}", in_quotes(section_name)), {},
                    meant.empty() ? fmt::format("sections are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean {}?", in_quotes(meant)));
    }
    constexpr size_t widest_range = 28;
    size_t key_width = 0;
    size_t range_width = 0;
    size_t default_width = 0;
    for (const Section& section : wanted) {
        for (const Parameter& parameter : section.parameters) {
            key_width = std::max(key_width, section.name.size() + 1 + parameter.key.size());
            range_width = std::max(range_width, std::min(widest_range, range_column(parameter).size()));
            default_width = std::max(default_width, default_column(parameter).size());
        }
    }
    constexpr std::array<const char*, 7> kinds = {"number", "integer", "toggle", "colour",
                                                  "choice", "text",    "file"};
    std::string text;
    for (const Section& section : wanted) {
        text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", section.name, section.help);
        for (const Parameter& parameter : section.parameters) {
            text +=
                fmt::format("  {:<{}}  {:<7}  {:<{}}  {:<{}}  {}\n", section.name + "." + parameter.key,
                            key_width, kinds.at(static_cast<size_t>(parameter.kind)), range_column(parameter),
                            range_width, default_column(parameter), default_width, parameter.help);
        }
    }
    if (overrides_ && section_name.empty()) {
        text += fmt::format("\nParameters that may differ by material or object, in a section such as "
                            "[material.\"brick*\".hatch]:\n{}",
                            overrides_help(sections_, Overridable::by_surface));
        text += fmt::format("\nParameters that may differ by object, in a section such as "
                            "[object.\"Lamp\".light]:\n{}",
                            overrides_help(sections_, Overridable::by_object));
    }
    return text;
}

std::string AnySchema::json_schema() const
{
    Json properties;
    properties["extends"] = {
        {"description",
         "Preset or style file that this style builds on: all values that are not set here come from there"},
        {"type", "string"}};
    for (const Section& section : sections_) {
        Json keys = Json::object();
        for (const Parameter& parameter : section.parameters) {
            add_key(keys, parameter.key, describe(parameter));
        }
        properties[section.name] = {{"description", section.help},
                                    {"type", "object"},
                                    {"properties", keys},
                                    {"additionalProperties", false}};
    }
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "Estampe style"},
                   {"type", "object"},
                   {"properties", properties},
                   {"additionalProperties", false}};
    if (overrides_) {
        schema["$defs"]["material"] = describe_overrides(sections_, Overridable::by_surface);
        schema["$defs"]["object"] = describe_overrides(sections_, Overridable::by_object);
        const auto patterns = [](const char* definition) {
            return Json{{"type", "object"}, {"additionalProperties", {{"$ref", definition}}}};
        };
        schema["properties"]["material"] = patterns("#/$defs/material");
        schema["properties"]["material"]["description"] =
            "Sections for materials whose names match a pattern, such as brick*, or that are of a named "
            "kind, "
            "such as kind:wood";
        schema["properties"]["object"] = patterns("#/$defs/object");
        schema["properties"]["object"]["description"] =
            "Sections for objects whose names match a pattern, such as tower*";
    }
    return schema.dump(2) + "\n";
}

} // namespace estampe::style
