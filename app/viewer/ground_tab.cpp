// SPDX-License-Identifier: MIT
// The viewer's tab for the terrain: the expressions of its height, and the other settings of its file.
#include <filesystem>

#include <estampe/error.hpp>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "techniques/terrain/graph/language.hpp"
#include "techniques/terrain/terrain_file.hpp"
#include "viewer/panels.hpp"

namespace estampe::viewer {
namespace {

const ImVec4 wrong_text{0.72F, 0.11F, 0.07F, 1.0F};
const ImVec4 wrong_field{0.97F, 0.80F, 0.76F, 1.0F};

void show_problem(const std::string& text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, wrong_text);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

void show_ground_save_field(Studio& studio)
{
    if (!ImGui::BeginPopup("save terrain")) {
        return;
    }
    ImGui::TextUnformatted("The ground, as a TOML file");
    if (ImGui::IsWindowAppearing()) {
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(18.0F * ImGui::GetFontSize());
    std::string& name = studio.terrain_save_name;
    const bool is_entered = ImGui::InputText("##name", &name, ImGuiInputTextFlags_EnterReturnsTrue);
    if ((ImGui::Button("Save") || is_entered) && !name.empty()) {
        name += name.ends_with(".toml") ? "" : ".toml";
        std::error_code problem;
        if (name != studio.terrain->name() && std::filesystem::exists(name, problem)) {
            studio.attempt("terrain file",
                           [&] { throw Error("is there already", name, "choose another name"); });
        } else {
            studio.save_terrain(name);
        }
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void show_buttons(Studio& studio, const PanelRequests& requests)
{
    const auto button = [&](const char* label, bool is_enabled) {
        ImGui::BeginDisabled(!is_enabled);
        const bool is_pressed = ImGui::Button(label);
        ImGui::EndDisabled();
        ImGui::SameLine();
        return is_pressed;
    };
    const TerrainEdit& terrain = *studio.terrain;
    if (button("Undo", terrain.can_undo())) {
        requests.act(Action::undo);
    }
    if (button("Redo", terrain.can_redo())) {
        requests.act(Action::redo);
    }
    if (button("Save", !terrain.problem())) {
        requests.act(Action::save_style);
    }
    if (button("Save as\u2026", !terrain.problem())) {
        studio.terrain_save_name = terrain.name();
        ImGui::OpenPopup("save terrain");
    }
    ImGui::NewLine();
    show_ground_save_field(studio);
}

/// Shows the text field for the expression of a node of the terrain, and its error below.
void show_expression(TerrainEdit& terrain, size_t node)
{
    std::string expression = terrain.draft().nodes[node].expression;
    const bool is_wrong = terrain.problem() && terrain.problem()->node == node;
    if (is_wrong) {
        ImGui::PushStyleColor(ImGuiCol_FrameBg, wrong_field);
    }
    if (ImGui::InputText("##expression", &expression)) {
        terrain.set_expression(node, expression);
    }
    if (is_wrong) {
        ImGui::PopStyleColor();
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        terrain.finish_change();
    }
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30.0F);
        ImGui::TextUnformatted(expression.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

void show_problem_of(const TerrainEdit& terrain, size_t node)
{
    if (terrain.problem() && terrain.problem()->node == node) {
        show_problem(terrain.problem()->text);
    }
}

void show_height(TerrainEdit& terrain)
{
    const auto& nodes = terrain.draft().nodes;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].name == "height") {
            ImGui::PushID(static_cast<int>(i));
            ImGui::AlignTextToFramePadding();
            ImGui::TextUnformatted("height =");
            ImGui::SameLine();
            ImGui::SetNextItemWidth(-1.0F);
            show_expression(terrain, i);
            show_problem_of(terrain, i);
            ImGui::PopID();
        }
    }
}

void show_nodes(TerrainEdit& terrain)
{
    const float line = ImGui::GetFontSize();
    std::optional<size_t> removed;
    for (size_t i = 0; i < terrain.draft().nodes.size(); ++i) {
        std::string name = terrain.draft().nodes[i].name;
        if (name == "height") {
            continue;
        }
        ImGui::PushID(static_cast<int>(i));
        ImGui::SetNextItemWidth(5.5F * line);
        if (ImGui::InputText("##name", &name)) {
            terrain.rename(i, name);
        }
        if (ImGui::IsItemDeactivatedAfterEdit()) {
            terrain.finish_change();
        }
        ImGui::SameLine();
        ImGui::TextUnformatted("=");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-2.2F * line);
        show_expression(terrain, i);
        ImGui::SameLine();
        if (ImGui::Button("\u00d7", {1.6F * line, 0.0F})) {
            removed = i;
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("remove %s", name.c_str());
        }
        show_problem_of(terrain, i);
        ImGui::PopID();
    }
    if (removed) {
        terrain.remove_node(*removed);
    }
    if (ImGui::Button("+ part")) {
        terrain.add_node();
    }
}

enum class Counts : uint8_t { at_once, when_finished };

/// Shows the settings of a section of the terrain's file other than its nodes.
template <typename Struct>
void show_settings(TerrainEdit& terrain, const style::Table<Struct>& table,
                   Struct TerrainDescription::*section, Counts counts)
{
    if (!ImGui::CollapsingHeader(table.section() == "terrain" ? "colour" : table.section().c_str())) {
        return;
    }
    TerrainDescription settings = terrain.draft();
    bool is_changed = false;
    bool is_finished = false;
    for (const style::Parameter& parameter : table.parameters()) {
        const RowEdit edit = show_parameter_row(table.section(), parameter,
                                                parameter.get(&(settings.*section)), parameter.default_value);
        if (edit.value) {
            parameter.set(&(settings.*section), *edit.value);
        }
        is_changed = is_changed || edit.value;
        is_finished = is_finished || edit.is_finished;
    }
    if (is_changed) {
        counts == Counts::at_once ? terrain.set_settings(settings) : terrain.hold_settings(settings);
    }
    if (is_finished) {
        terrain.finish_change();
    }
}

void show_functions()
{
    if (!ImGui::CollapsingHeader("What heights are made of")) {
        return;
    }
    ImGui::TextWrapped(
        "Numbers, names of parts, x and z in metres, time in seconds, wind in metres a second, "
        "pi, brackets, + - * / ^, and:");
    for (const terrain::NodeKind& kind : terrain::node_kinds()) {
        const bool is_sign = kind.name.size() == 1;
        if (is_sign) {
            continue;
        }
        ImGui::Spacing();
        ImGui::TextWrapped("%s", terrain::signature(kind).c_str());
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        ImGui::TextWrapped("%s", std::string(kind.help).c_str());
        ImGui::PopStyleColor();
    }
}

} // namespace

void show_ground_tab(Studio& studio, const PanelRequests& requests)
{
    if (!studio.terrain) {
        ImGui::TextWrapped("The scene stands on no terrain. Drop a terrain's TOML file here, or begin with "
                           "--terrain.");
        return;
    }
    TerrainEdit& terrain = *studio.terrain;
    const std::string name = std::filesystem::path(terrain.name()).filename().string();
    ImGui::TextDisabled("%s%s", name.c_str(), terrain.is_changed() ? ", changed" : "");
    show_buttons(studio, requests);
    ImGui::Spacing();
    ImGui::BeginChild("ground");
    show_height(terrain);
    ImGui::Spacing();
    show_nodes(terrain);
    if (terrain.problem() && !terrain.problem()->node) {
        show_problem(terrain.problem()->text);
    }
    ImGui::Spacing();
    show_settings(terrain, terrain::wind_table(), &TerrainDescription::wind, Counts::at_once);
    show_settings(terrain, terrain::mesh_table(), &TerrainDescription::meshing, Counts::when_finished);
    show_settings(terrain, terrain::ripples_table(), &TerrainDescription::ripples, Counts::at_once);
    show_settings(terrain, terrain::trails_table(), &TerrainDescription::trails, Counts::at_once);
    show_settings(terrain, terrain::look_table(), &TerrainDescription::look, Counts::at_once);
    show_functions();
    ImGui::EndChild();
}

} // namespace estampe::viewer
