// SPDX-License-Identifier: MIT
// Controls for the parameters of a style, made from their descriptions.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "features/common/style_tables.hpp"
#include "style/raw.hpp"
#include "viewer/panels.hpp"
#include "viewer/parameter_row.hpp"
#include "viewer/parameter_search.hpp"

namespace estampe::viewer {
namespace {

using style::Kind;
using style::Parameter;
using style::Value;

void set_value(Studio& studio, const std::string& section, const Parameter& parameter, void* values,
               const Value& value)
{
    const std::string name = section + "." + parameter.key;
    if (parameter.kind == Kind::text || parameter.kind == Kind::file) {
        studio.attempt("style",
                       [&] { studio.look.set(fmt::format("{}={}", name, style::format_value(value))); });
        return;
    }
    parameter.set(values, value);
    studio.look.changed();
    studio.settle("style");
}

/// `base` are the values to go back to.
void show_row(Studio& studio, const style::Sheet::Section& section, const Parameter& parameter,
              const void* base)
{
    const RowEdit edit =
        show_parameter_row(section.name, parameter, parameter.get(section.values), parameter.get(base));
    if (edit.value) {
        set_value(studio, section.name, parameter, section.values, *edit.value);
    }
    if (edit.is_finished) {
        studio.look.finish_change_if_any(); // of a drag once, at its end
    }
}

bool is_wanted(std::span<const char* const> sections, const std::string& name)
{
    return sections.empty() || std::ranges::find(sections, name) != sections.end();
}

} // namespace

void show_parameters(Studio& studio, const std::string& search, std::span<const char* const> sections)
{
    style::Sheet sheet = features::sheet_of(studio.look.style().tables());
    features::StyleTables base = studio.look.base().tables();
    const style::Sheet base_sheet = features::sheet_of(base);
    bool any = false;
    for (size_t i = 0; i < sheet.sections().size(); ++i) {
        const style::Sheet::Section& section = sheet.sections()[i];
        const void* base_values = base_sheet.sections()[i].values;
        if (!is_wanted(sections, section.name) || !matches(section, search)) {
            continue;
        }
        any = true;
        const auto changed = std::ranges::count_if(section.parameters, [&](const Parameter& parameter) {
            return parameter.get(section.values) != parameter.get(base_values);
        });
        // What a search opens is closed again after it.
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
                parameter.set(section.values, parameter.get(base_values));
            }
            studio.look.finish_change();
        }
        for (const Parameter& parameter : section.parameters) {
            if (matches(section, parameter, search)) {
                show_row(studio, section, parameter, base_values);
            }
        }
    }
    if (!any) {
        ImGui::TextDisabled("nothing of that name");
    }
}

} // namespace estampe::viewer
