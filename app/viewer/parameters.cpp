// SPDX-License-Identifier: MIT
// The viewer's controls for style parameters, generated from the parameters' descriptions, and the search for
// parameters.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "style/toml.hpp"
#include "viewer/panels.hpp"

namespace estampe::viewer {

bool matches(const style::Section& section, const style::Parameter& parameter, const std::string& search)
{
    const std::string text = lower_case(section.name + "." + parameter.key + " " + parameter.help);
    std::istringstream words(lower_case(search));
    std::string word;
    while (words >> word) {
        if (text.find(word) == std::string::npos) {
            return false;
        }
    }
    return true;
}

bool matches(const style::Section& section, const std::string& search)
{
    return std::ranges::any_of(section.parameters, [&](const style::Parameter& parameter) {
        return matches(section, parameter, search);
    });
}

namespace {

using style::Kind;
using style::Parameter;
using style::Value;

constexpr int slider_flags = ImGuiSliderFlags_AlwaysClamp;

/// Returns whether a range is so wide that its slider should be logarithmic.
bool is_wide(const style::Range& range)
{
    constexpr float wide = 200.0F;
    return range.minimum >= 0.0F && range.maximum > wide * std::max(range.minimum, 0.01F) &&
           range.maximum > 5.0F;
}

/// Returns a printf format with as many decimals as a step of the slider needs. In a wide range, the step
/// depends on the current value.
std::string digits_of(const Parameter& parameter, float number)
{
    const float width =
        is_wide(parameter.range) ? 10.0F * number : parameter.range.maximum - parameter.range.minimum;
    const int digits = width > 50.0F ? 1 : width > 5.0F ? 2 : 3;
    return fmt::format("%.{}f{}", digits, parameter.unit.empty() ? "" : " " + parameter.unit);
}

bool edit_number(const Parameter& parameter, Value& value)
{
    float number = std::get<float>(value);
    const int flags =
        slider_flags | (is_wide(parameter.range) ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    const bool changed =
        ImGui::SliderFloat("##value", &number, parameter.range.minimum, parameter.range.maximum,
                           digits_of(parameter, number).c_str(), flags);
    value = number;
    return changed && std::isfinite(number);
}

bool edit_integer(const Parameter& parameter, Value& value)
{
    auto number = static_cast<int>(std::get<int64_t>(value));
    const std::string format = "%d" + (parameter.unit.empty() ? "" : " " + parameter.unit);
    const auto least = static_cast<int>(parameter.integers.minimum);
    const auto most = static_cast<int>(parameter.integers.maximum);
    const bool changed = ImGui::SliderInt("##value", &number, least, most, format.c_str(), slider_flags);
    value = int64_t{number};
    return changed;
}

/// Shows a control for a colour. A colour that may be "auto" has a checkbox before it; turning "auto" off
/// sets the colour to black at first.
bool edit_color(const Parameter& parameter, Value& value)
{
    if (!parameter.choices.empty()) {
        bool has_color = std::holds_alternative<glm::vec3>(value);
        const bool toggled = ImGui::Checkbox("##own", &has_color);
        if (toggled) {
            value = has_color ? Value(glm::vec3(0.0F)) : Value(parameter.choices.front());
        }
        ImGui::SameLine();
        if (!has_color) {
            ImGui::TextDisabled("%s", parameter.choices.front().c_str());
        }
        if (toggled || !has_color) {
            return toggled;
        }
    }
    const glm::dvec3 srgb = style::srgb_from_linear(std::get<glm::vec3>(value));
    std::array<float, 3> parts{static_cast<float>(srgb.x), static_cast<float>(srgb.y),
                               static_cast<float>(srgb.z)};
    const bool changed = ImGui::ColorEdit3("##value", parts.data(),
                                           ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_NoLabel);
    if (changed) {
        // The colour is rounded as --set does, to eight bits per channel.
        const auto byte = [](float part) {
            return static_cast<uint32_t>(std::lround(std::clamp(part, 0.0F, 1.0F) * 255.0F));
        };
        value = style::srgb(byte(parts[0]) << 16U | byte(parts[1]) << 8U | byte(parts[2]));
    }
    return changed;
}

bool edit_choice(const Parameter& parameter, Value& value)
{
    const std::string shown = std::get<std::string>(value);
    bool changed = false;
    if (ImGui::BeginCombo("##value", shown.c_str())) {
        for (const std::string& choice : parameter.choices) {
            if (ImGui::Selectable(choice.c_str(), choice == shown)) {
                value = choice;
                changed = choice != shown;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

/// Shows a text field for a word or a file name. The text applies when the input is complete.
bool edit_text(const Parameter& parameter, Value& value)
{
    const std::string held = std::get<std::string>(value);
    std::string text = held;
    const char* hint = parameter.kind == Kind::file ? "file" : "";
    if (ImGui::InputTextWithHint("##value", hint, &text, ImGuiInputTextFlags_EnterReturnsTrue)) {
        value = text;
        return text != held;
    }
    return false;
}

bool edit(const Parameter& parameter, Value& value)
{
    switch (parameter.kind) {
    case Kind::number:
        return edit_number(parameter, value);
    case Kind::integer:
        return edit_integer(parameter, value);
    case Kind::toggle: {
        bool on = std::get<bool>(value);
        const bool changed = ImGui::Checkbox("##value", &on);
        value = on;
        return changed;
    }
    case Kind::color:
        return edit_color(parameter, value);
    case Kind::choice:
        return edit_choice(parameter, value);
    case Kind::text:
    case Kind::file:
        return edit_text(parameter, value);
    }
    return false;
}

void show_help(const std::string& name, const Parameter& parameter)
{
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0F);
    ImGui::TextUnformatted(name.c_str());
    ImGui::TextUnformatted(parameter.help.c_str());
    const std::string facts = fmt::format("{}; {} by itself", style::allowed(parameter),
                                          style::format_value(parameter.default_value));
    ImGui::TextDisabled("%s", facts.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// Returns the label of a parameter: "width" for "width_mm".
std::string label_of(const Parameter& parameter)
{
    std::string label = parameter.key;
    std::string ending = "_" + parameter.unit;
    std::ranges::replace(ending, '/', '_');
    if (!parameter.unit.empty() && label.ends_with(ending)) {
        label.resize(label.size() - ending.size());
    }
    std::ranges::replace(label, '_', ' ');
    return label;
}

/// Returns whether the user picks the parameter's value from a list instead of dragging a slider. A picked
/// value applies at once.
bool is_picked(const Parameter& parameter)
{
    return parameter.kind != Kind::number && parameter.kind != Kind::integer && parameter.kind != Kind::color;
}

} // namespace

RowEdit show_parameter_row(const std::string& section, const Parameter& parameter, const Value& held,
                           const Value& base)
{
    const std::string name = section + "." + parameter.key;
    const float line = ImGui::GetFontSize();
    const float width = ImGui::GetContentRegionAvail().x;
    RowEdit result;
    Value value = held;
    ImGui::PushID(name.c_str());
    ImGui::AlignTextToFramePadding();
    const std::string label = label_of(parameter);
    ImGui::TextUnformatted(label.c_str());
    if (ImGui::IsItemHovered()) {
        show_help(name, parameter);
    }
    ImGui::SameLine(0.42F * width);
    ImGui::SetNextItemWidth(0.58F * width - 1.9F * line);
    if (edit(parameter, value)) {
        result.value = value;
        result.is_finished = is_picked(parameter);
    }
    result.is_finished = result.is_finished || ImGui::IsItemDeactivatedAfterEdit();
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
        show_help(name, parameter);
    }
    if (held != base) {
        ImGui::SameLine(width - 1.5F * line);
        if (ImGui::Button("\u21ba", {1.5F * line, 0.0F})) {
            result = {.value = base, .is_finished = true};
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("back to %s", style::format_value(base).c_str());
        }
    }
    ImGui::PopID();
    return result;
}

namespace {

void set_value(Studio& studio, const std::string& section, const Parameter& parameter, void* values,
               const Value& value)
{
    const std::string name = section + "." + parameter.key;
    if (parameter.kind == Kind::text || parameter.kind == Kind::file) {
        studio.attempt("style",
                       [&] { studio.edited.set(fmt::format("{}={}", name, style::format_value(value))); });
        return;
    }
    parameter.set(values, value);
    studio.edited.changed();
    studio.settle("style");
}

/// Shows the row of a parameter. `base` holds the values for the reset button.
void show_row(Studio& studio, const std::string& section, const Parameter& parameter, void* values,
              const void* base)
{
    const RowEdit edit = show_parameter_row(section, parameter, parameter.get(values), parameter.get(base));
    if (edit.value) {
        set_value(studio, section, parameter, values, *edit.value);
    }
    if (edit.is_finished) {
        studio.edited.finish_change_if_any(); // A drag adds one undo step when it ends
    }
}

bool is_wanted(std::span<const char* const> sections, const std::string& name)
{
    return sections.empty() || std::ranges::find(sections, name) != sections.end();
}

} // namespace

void show_parameters(Studio& studio, const std::string& search, std::span<const char* const> sections)
{
    bool any = false;
    for (const style::Section& section : features::style_schema().sections()) {
        void* const values = section.place.in(&studio.edited.style().tables());
        const void* const base = section.place.in(&studio.edited.base().tables());
        if (!is_wanted(sections, section.name) || !matches(section, search)) {
            continue;
        }
        any = true;
        const auto changed = std::ranges::count_if(section.parameters, [&](const Parameter& parameter) {
            return parameter.get(values) != parameter.get(base);
        });
        // A section has a second ID while it is shown by a search, so that sections opened by the search are
        // closed again afterwards.
        const std::string id = section.name + (search.empty() ? "" : " found");
        const std::string title = changed > 0
                                      ? fmt::format("{}  ({} changed)###{}", section.name, changed, id)
                                      : fmt::format("{}###{}", section.name, id);
        if (!search.empty()) {
            ImGui::SetNextItemOpen(true);
        }
        const bool is_open = ImGui::CollapsingHeader(
            title.c_str(), sections.empty() ? ImGuiTreeNodeFlags_None : ImGuiTreeNodeFlags_DefaultOpen);
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", section.help.c_str());
        }
        if (!is_open) {
            continue;
        }
        if (changed > 0 && ImGui::SmallButton(("\u21ba all of " + section.name).c_str())) {
            for (const Parameter& parameter : section.parameters) {
                parameter.set(values, parameter.get(base));
            }
            studio.edited.finish_change();
        }
        for (const Parameter& parameter : section.parameters) {
            if (matches(section, parameter, search)) {
                show_row(studio, section.name, parameter, values, base);
            }
        }
    }
    if (!any) {
        ImGui::TextDisabled("nothing of that name");
    }
}

} // namespace estampe::viewer
