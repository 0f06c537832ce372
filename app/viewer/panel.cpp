// SPDX-License-Identifier: MIT
// The viewer's panel on the right and its tabs.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <estampe/error.hpp>
#include <estampe/style.hpp>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "features/common/style_tables.hpp"
#include "viewer/panels.hpp"

namespace estampe::viewer {
namespace {

constexpr float panel_points = 350.0F;
/// Width of the panel; wider than usual, because expressions for terrain heights are long.
constexpr float ground_points = 480.0F;
constexpr float bar_points = 34.0F;

const char* title_of(PanelTab tab)
{
    switch (tab) {
    case PanelTab::style:
        return "Style";
    case PanelTab::light:
        return "Light";
    case PanelTab::ground:
        return "Ground";
    case PanelTab::layers:
        return "Layers";
    case PanelTab::views:
        return "Views";
    case PanelTab::timings:
        return "Timings";
    }
    return "";
}

void show_preset_list(Studio& studio, const PanelRequests& requests)
{
    const std::string& name = studio.edited.name();
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##preset", name.empty() ? "built-in style" : name.c_str(),
                          ImGuiComboFlags_HeightLarge)) {
        if (ImGui::Selectable("built-in style", name.empty())) {
            requests.open_style("");
        }
        for (const std::string& preset : Style::presets()) {
            if (ImGui::Selectable(preset.c_str(), preset == name)) {
                requests.open_style(preset);
            }
            if (ImGui::IsItemHovered()) {
                ImGui::SetTooltip("%s", Style::about(preset).c_str());
            }
        }
        ImGui::EndCombo();
    }
}

void show_style_buttons(Studio& studio, const PanelRequests& requests)
{
    ImGui::BeginDisabled(!studio.edited.can_undo());
    if (ImGui::Button("Undo")) {
        requests.act(Action::undo);
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!studio.edited.can_redo());
    if (ImGui::Button("Redo")) {
        requests.act(Action::redo);
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button(studio.comparison.other ? "End A|B" : "A|B")) {
        requests.act(Action::compare);
    }
    ImGui::SameLine();
    if (ImGui::Button("Save as\u2026")) {
        requests.act(Action::save_style);
    }
}

void show_save_field(Studio& studio)
{
    if (!ImGui::BeginPopup("save style")) {
        return;
    }
    ImGui::TextUnformatted("All parameters, as a TOML file");
    if (ImGui::IsWindowAppearing()) {
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(18.0F * ImGui::GetFontSize());
    const bool entered = ImGui::InputText("##name", &studio.save_name, ImGuiInputTextFlags_EnterReturnsTrue);
    if ((ImGui::Button("Save") || entered) && !studio.save_name.empty()) {
        if (!studio.save_name.ends_with(".toml")) {
            studio.save_name += ".toml";
        }
        studio.attempt("style", [&] {
            std::error_code problem;
            if (studio.save_name != studio.edited.name() &&
                std::filesystem::exists(studio.save_name, problem)) {
                throw Error("is there already", studio.save_name, "choose another name");
            }
            studio.edited.save(studio.save_name);
            studio.say(Message::Kind::note, "saved", "wrote " + studio.save_name);
        });
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

/// Shows the choice of the axis of the file that points up; a change loads the scene again.
void show_up_axes(Studio& studio, const PanelRequests& requests)
{
    struct Choice {
        const char* name;
        std::optional<UpAxis> up;
    };

    static const std::array<Choice, 7> choices{{{"as the file says", std::nullopt},
                                                {"x", UpAxis::x},
                                                {"y", UpAxis::y},
                                                {"z", UpAxis::z},
                                                {"-x", UpAxis::minus_x},
                                                {"-y", UpAxis::minus_y},
                                                {"-z", UpAxis::minus_z}}};
    const auto* const now = std::ranges::find(choices, studio.up, &Choice::up);
    if (ImGui::BeginCombo("Up axis", now->name)) {
        for (const Choice& choice : choices) {
            if (ImGui::Selectable(choice.name, choice.up == studio.up) && choice.up != studio.up) {
                studio.up = choice.up;
                requests.act(Action::reload);
            }
        }
        ImGui::EndCombo();
    }
}

/// Begins a bar of tabs with little spacing, so that all names fit.
template <typename Begin>
bool narrowly(const Begin& begin)
{
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const ImVec2 spacing = ImGui::GetStyle().ItemInnerSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.6F * padding.x, padding.y});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {0.3F * spacing.x, spacing.y});
    const bool is_open = begin();
    ImGui::PopStyleVar(2);
    return is_open;
}

/// Shows a checkbox for a layer whose parameter is not a boolean. Turning the layer on restores the
/// parameter's value in `base`.
template <typename T>
void show_layer(Studio& studio, const char* name, T& value, const T& base, const T& off, const T& usual)
{
    bool on = value != off;
    if (ImGui::Checkbox(name, &on)) {
        value = !on ? off : base != off ? base : usual;
        studio.edited.finish_change();
    }
}

} // namespace

Area picture_area(const Studio& studio, float content_scale)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    Area area{.width = size.x, .height = size.y};
    if (studio.shows_bars) {
        area.height -= std::round(bar_points * content_scale);
        if (studio.shows_panel) {
            const float points = studio.tab == PanelTab::ground ? ground_points : panel_points;
            area.width -= std::min(std::round(points * content_scale), 0.6F * size.x);
        }
    }
    area.width = std::max(std::floor(area.width), 1.0F);
    area.height = std::max(std::floor(area.height), 1.0F);
    return area;
}

void show_style_tab(Studio& studio, const PanelRequests& requests)
{
    show_preset_list(studio, requests);
    show_style_buttons(studio, requests);
    if (studio.wants_save) {
        ImGui::OpenPopup("save style");
        studio.wants_save = false;
    }
    show_save_field(studio);
    if (studio.wants_search) {
        ImGui::SetKeyboardFocusHere();
        studio.wants_search = false;
    }
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::InputTextWithHint("##search", "Search: width, shadow, ink\u2026", &studio.search);
    ImGui::Spacing();
    ImGui::BeginChild("parameters");
    show_parameters(studio, studio.search, {});
    ImGui::EndChild();
}

void show_light_tab(Studio& studio)
{
    static constexpr std::array sections{"light", "sun", "shadow", "tone"};
    ImGui::TextDisabled("Hold L and drag over the picture to turn the sun.");
    ImGui::Spacing();
    ImGui::BeginChild("light");
    show_parameters(studio, "", sections);
    ImGui::EndChild();
}

void show_layers_tab(Studio& studio)
{
    features::StyleTables& tables = studio.edited.style().tables();
    const features::StyleTables& base = studio.edited.base().tables();
    const features::StyleTables plain;
    ImGui::TextDisabled("What lies on the page, from above");
    ImGui::Spacing();
    show_layer(studio, "Lines", tables.contour.enabled, true, false, true);
    show_layer(studio, "Hatching", tables.hatch.enabled, true, false, true);
    show_layer(studio, "Shadows", tables.light.shadows, true, false, true);
    show_layer(studio, "Wash", tables.wash.strength, base.wash.strength, 0.0F, plain.wash.strength);
    show_layer(studio, "Sky", tables.sky.enabled, base.sky.enabled, style::AutoToggle::off,
               plain.sky.enabled);
    show_layer(studio, "Ground", tables.picture.ground, base.picture.ground, style::AutoToggle::off,
               plain.picture.ground);
    show_layer(studio, "Grain of the paper", tables.paper.grain, base.paper.grain, 0.0F, plain.paper.grain);
    show_layer(studio, "Border", tables.paper.border_mm, base.paper.border_mm, 0.0F, 0.35F);
}

void show_views_tab(Studio& studio, const PanelRequests& requests)
{
    if (!studio.file) {
        ImGui::TextDisabled("There is no scene yet.");
        return;
    }
    if (ImGui::Button("Keep this view")) {
        studio.add_bookmark();
    }
    ImGui::SameLine();
    if (ImGui::Button("The first view")) {
        studio.rig.go_home();
    }
    show_up_axes(studio, requests);
    ImGui::Spacing();
    std::optional<size_t> removed;
    for (size_t i = 0; i < studio.bookmarks.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const float line = ImGui::GetFontSize();
        if (ImGui::Selectable(studio.bookmarks[i].name.c_str(), studio.bookmark == i, 0,
                              {ImGui::GetContentRegionAvail().x - 2.0F * line, 0.0F})) {
            studio.go_to_bookmark(i);
        }
        ImGui::SameLine();
        if (ImGui::SmallButton("\u00d7")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        studio.remove_bookmark(*removed);
    }
    const Scene& scene = studio.file->scene;
    if (!scene.cameras.empty()) {
        ImGui::Spacing();
        ImGui::TextDisabled("Cameras of the file");
    }
    for (size_t i = 0; i < scene.cameras.size(); ++i) {
        const std::string name =
            scene.cameras[i].name.empty() ? fmt::format("camera {}", i) : scene.cameras[i].name;
        if (ImGui::Selectable(fmt::format("{}##camera{}", name, i).c_str())) {
            studio.attempt("camera", [&] {
                const ScenePose pose = pose_scene(scene, studio.time.time_s, studio.time.animation);
                studio.rig.set_mode(CameraMode::orbit);
                studio.rig.place(scene_camera(scene, pose, std::to_string(i)));
            });
        }
    }
}

void show_timings_tab(Studio& studio)
{
    const std::string title =
        fmt::format("{} at {} x {}", studio.device, studio.shown_px.x, studio.shown_px.y);
    ImGui::TextWrapped("%s", title.c_str());
    const std::vector<float> times(studio.frame_ms.begin(), studio.frame_ms.end());
    if (!times.empty()) {
        // The scale of the diagram leaves out the first frame, which takes long because it compiles shaders.
        std::vector<float> sorted = times;
        std::ranges::sort(sorted);
        const float most = 1.5F * std::max(sorted[sorted.size() * 9 / 10], 45.0F);
        const std::string now = fmt::format("{:.0f} ms a picture", times.back());
        ImGui::PlotLines("##pictures", times.data(), static_cast<int>(times.size()), 0, now.c_str(), 0.0F,
                         most, {-1.0F, 5.0F * ImGui::GetFontSize()});
    }
    double sum_ms = 0.0;
    double most_ms = 1e-3;
    for (const PassTiming& pass : studio.passes) {
        sum_ms += pass.gpu_ms;
        most_ms = std::max(most_ms, pass.gpu_ms);
    }
    ImGui::TextDisabled(
        "%s", fmt::format("{} passes, {:.1f} ms on the device", studio.passes.size(), sum_ms).c_str());
    ImGui::BeginChild("passes");
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {4.0F, 0.0F});
    for (const PassTiming& pass : studio.passes) {
        const std::string label = fmt::format("{:.2f}", pass.gpu_ms);
        ImGui::TextUnformatted(pass.name.c_str());
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s: %s ms", pass.name.c_str(), label.c_str());
        }
        ImGui::SameLine(0.55F * width);
        ImGui::ProgressBar(static_cast<float>(pass.gpu_ms / most_ms), {-1.0F, ImGui::GetFontSize()},
                           label.c_str());
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

void show_panel(Studio& studio, const PanelRequests& requests, float content_scale)
{
    const Area area = picture_area(studio, content_scale);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({area.width, 0.0F});
    ImGui::SetNextWindowSize({size.x - area.width, area.height});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    if (narrowly([] { return ImGui::BeginTabBar("tabs"); })) {
        for (const PanelTab tab : {PanelTab::style, PanelTab::light, PanelTab::ground, PanelTab::layers,
                                   PanelTab::views, PanelTab::timings}) {
            const bool is_chosen = studio.wants_tab && studio.tab == tab;
            if (narrowly([&] {
                    return ImGui::BeginTabItem(title_of(tab), nullptr,
                                               is_chosen ? ImGuiTabItemFlags_SetSelected
                                                         : ImGuiTabItemFlags_None);
                })) {
                if (!studio.wants_tab || is_chosen) {
                    studio.tab = tab;
                    studio.wants_tab = false;
                }
                ImGui::Spacing();
                switch (tab) {
                case PanelTab::style:
                    show_style_tab(studio, requests);
                    break;
                case PanelTab::light:
                    show_light_tab(studio);
                    break;
                case PanelTab::ground:
                    show_ground_tab(studio, requests);
                    break;
                case PanelTab::layers:
                    show_layers_tab(studio);
                    break;
                case PanelTab::views:
                    show_views_tab(studio, requests);
                    break;
                case PanelTab::timings:
                    show_timings_tab(studio);
                    break;
                }
                ImGui::EndTabItem();
            }
        }
        ImGui::EndTabBar();
    }
    ImGui::End();
}

} // namespace estampe::viewer
