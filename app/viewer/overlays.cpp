// SPDX-License-Identifier: MIT
// The theme of all panels, and the overlays on the viewer's picture: status bar, messages, list of keys.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels.hpp"

namespace estampe::viewer {
namespace {

constexpr float text_points = 14.0F;

/// Sans-serif fonts at their usual paths in Linux distributions; if none exists, ImGui's own font is used.
constexpr std::array font_files{"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf",
                                "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void load_font(float size_px)
{
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    // Unicode ranges of the glyphs in the font texture: Latin letters, dashes, arrows and the symbols of the
    // panels.
    static const std::array<ImWchar, 9> ranges{0x20,   0x17f,  0x2010, 0x2027, 0x2190,
                                               0x21bf, 0x25a0, 0x25ff, 0};
    for (const char* file : font_files) {
        std::error_code problem;
        if (std::filesystem::exists(file, problem)) {
            ImFontConfig config;
            config.OversampleH = 2;
            if (atlas.AddFontFromFileTTF(file, size_px, &config, ranges.data()) != nullptr) {
                return;
            }
        }
    }
    ImFontConfig config;
    config.SizePixels = size_px;
    atlas.AddFontDefault(&config);
}

ImVec4 color(uint32_t rrggbb, float alpha = 1.0F)
{
    const auto part = [&](uint32_t shift) { return static_cast<float>((rrggbb >> shift) & 0xffU) / 255.0F; };
    return {part(16U), part(8U), part(0U), alpha};
}

void set_colors(ImGuiStyle& style)
{
    constexpr uint32_t ink = 0x2a2825;
    constexpr uint32_t paper = 0xf4f1ea;
    constexpr uint32_t field = 0xe7e2d7;
    constexpr uint32_t pressed = 0xd5cebf;
    constexpr uint32_t accent = 0x9c4a2f;
    ImGui::StyleColorsLight(&style);
    const auto set = [&](ImGuiCol which, const ImVec4& value) { style.Colors[which] = value; };
    set(ImGuiCol_Text, color(ink));
    set(ImGuiCol_TextDisabled, color(ink, 0.55F));
    set(ImGuiCol_WindowBg, color(paper));
    set(ImGuiCol_ChildBg, color(paper, 0.0F));
    set(ImGuiCol_PopupBg, color(0xfbf9f4));
    set(ImGuiCol_Border, color(ink, 0.14F));
    set(ImGuiCol_FrameBg, color(field));
    set(ImGuiCol_FrameBgHovered, color(0xdfd8ca));
    set(ImGuiCol_FrameBgActive, color(pressed));
    set(ImGuiCol_CheckMark, color(accent));
    set(ImGuiCol_SliderGrab, color(ink, 0.28F));
    set(ImGuiCol_SliderGrabActive, color(accent, 0.6F));
    set(ImGuiCol_Button, color(field));
    set(ImGuiCol_ButtonHovered, color(0xdfd8ca));
    set(ImGuiCol_ButtonActive, color(pressed));
    set(ImGuiCol_Header, color(field, 0.7F));
    set(ImGuiCol_HeaderHovered, color(0xdfd8ca));
    set(ImGuiCol_HeaderActive, color(pressed));
    set(ImGuiCol_Separator, color(ink, 0.12F));
    set(ImGuiCol_Tab, color(paper));
    set(ImGuiCol_TabHovered, color(0xdfd8ca));
    set(ImGuiCol_TabActive, color(field));
    set(ImGuiCol_ScrollbarBg, color(paper, 0.0F));
    set(ImGuiCol_ScrollbarGrab, color(ink, 0.2F));
    set(ImGuiCol_ScrollbarGrabHovered, color(ink, 0.35F));
    set(ImGuiCol_ScrollbarGrabActive, color(ink, 0.5F));
    set(ImGuiCol_PlotHistogram, color(accent, 0.75F));
    set(ImGuiCol_PlotLines, color(accent));
    set(ImGuiCol_TextSelectedBg, color(accent, 0.25F));
    set(ImGuiCol_NavHighlight, color(accent));
}

} // namespace

void apply_theme(float content_scale)
{
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    set_colors(style);
    style.WindowPadding = {10.0F, 8.0F};
    style.FramePadding = {7.0F, 3.0F};
    style.ItemSpacing = {7.0F, 5.0F};
    style.WindowRounding = 0.0F;
    style.FrameRounding = 3.0F;
    style.GrabRounding = 3.0F;
    style.TabRounding = 3.0F;
    style.PopupRounding = 4.0F;
    style.WindowBorderSize = 0.0F;
    style.PopupBorderSize = 1.0F;
    style.ScrollbarSize = 11.0F;
    style.GrabMinSize = 9.0F;
    style.ScaleAllSizes(content_scale);
    load_font(text_points * content_scale);
}

namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

const char* mode_name(CameraMode mode)
{
    return mode == CameraMode::orbit ? "orbit" : mode == CameraMode::fly ? "fly" : "walk";
}

/// Returns the text of the status line: "helmet.gltf - pencil - 960 x 540, 75 % - 64 ms".
std::string status_of(const Studio& studio)
{
    std::string text;
    if (studio.file) {
        text = std::filesystem::path(studio.file->draw.scene).filename().string();
        text += " \u00b7 " + (studio.edited.name().empty()
                                  ? std::string("built-in style")
                                  : std::filesystem::path(studio.edited.name()).filename().string());
    }
    if (studio.rig.mode() != CameraMode::orbit) {
        text += fmt::format(" \u00b7 {}", mode_name(studio.rig.mode()));
    }
    if (studio.shown_px.x > 0) {
        text += fmt::format(" \u00b7 {} x {}, {:.0f} % \u00b7 {:.0f} ms", studio.view_px.x, studio.view_px.y,
                            100.0 * studio.shown_scale, 1e3 * studio.shown_s);
    }
    return text;
}

void show_timeline(Studio& studio, const PanelRequests& requests, float width)
{
    Timeline& time = studio.time;
    const float line = ImGui::GetFontSize();
    if (ImGui::Button(time.is_playing ? "Pause" : "Play", {3.6F * line, 0.0F})) {
        requests.act(Action::play);
    }
    ImGui::SameLine();
    auto moment = static_cast<float>(time.time_s);
    ImGui::SetNextItemWidth(width);
    const std::string shown = time.is_endless ? "%.2f s" : fmt::format("%.2f of {:.2f} s", time.length_s);
    constexpr float s_a_pixel = 0.05F;
    constexpr auto flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
    if (time.is_endless ? ImGui::DragFloat("##time", &moment, s_a_pixel, 0.0F, 1e9F, shown.c_str(), flags)
                        : ImGui::SliderFloat("##time", &moment, 0.0F, static_cast<float>(time.length_s),
                                             shown.c_str(), flags)) {
        time.seek(moment);
        time.is_playing = false;
    }
    ImGui::SameLine();
    if (!time.is_endless) {
        ImGui::Checkbox("loop", &time.loops);
        ImGui::SameLine();
    }
    auto speed = static_cast<float>(time.speed);
    ImGui::SetNextItemWidth(5.5F * line);
    if (ImGui::SliderFloat("##speed", &speed, 0.1F, 4.0F, "%.2f x",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
        time.speed = speed;
    }
    ImGui::SameLine();
    const std::vector<Animation>& animations = studio.file->scene.animations;
    if (animations.size() > 1) {
        ImGui::SetNextItemWidth(7.0F * line);
        if (ImGui::BeginCombo("##animation", animations[time.animation].name.c_str())) {
            for (Index i = 0; i < animations.size(); ++i) {
                if (ImGui::Selectable(fmt::format("{}##{}", animations[i].name, i).c_str(),
                                      i == time.animation)) {
                    time.animation = i;
                    time.length_s = animations[i].duration_s;
                    time.time_s = 0.0;
                }
            }
            ImGui::EndCombo();
        }
        ImGui::SameLine();
    }
}

void show_key_group(const KeyGroup& group, float content_scale)
{
    ImGui::TextDisabled("%s", group.title);
    if (ImGui::BeginTable(group.title, 2)) {
        ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 164.0F * content_scale);
        ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthStretch);
        for (const KeyHelp& key : group.keys) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(key.name);
            ImGui::TableNextColumn();
            ImGui::PushTextWrapPos(0.0F);
            ImGui::TextUnformatted(key.help);
            ImGui::PopTextWrapPos();
        }
        ImGui::EndTable();
    }
    ImGui::Spacing();
}

void show_work(const Studio& studio, const PanelRequests& requests, const Area& area, float content_scale)
{
    const float width = std::min(360.0F * content_scale, area.width - 20.0F);
    ImGui::SetNextWindowPos({area.x + 0.5F * area.width, area.y + area.height - 16.0F * content_scale},
                            ImGuiCond_Always, {0.5F, 1.0F});
    ImGui::SetNextWindowSize({width, 0.0F});
    ImGui::Begin("work", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextUnformatted(studio.work->text.c_str());
    const float button = 5.0F * ImGui::GetFontSize();
    // If the share of the work done is not known, the progress bar moves back and forth.
    const auto moving = static_cast<float>(0.5 + 0.5 * std::sin(3.0 * ImGui::GetTime()));
    const float share = studio.work->share >= 0.0 ? static_cast<float>(studio.work->share) : moving;
    ImGui::ProgressBar(share, {width - button - 3.0F * ImGui::GetStyle().WindowPadding.x, 0.0F},
                       studio.work->share >= 0.0 ? nullptr : "");
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {button, 0.0F})) {
        requests.cancel_work();
    }
    ImGui::End();
}

} // namespace

void show_bar(Studio& studio, const PanelRequests& requests, float content_scale)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Area area = picture_area(studio, content_scale);
    ImGui::SetNextWindowPos({0.0F, area.height});
    ImGui::SetNextWindowSize({size.x, size.y - area.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0F * content_scale, 5.0F * content_scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::Begin("bar", nullptr, fixed | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const std::string status = status_of(studio) + "    ? keys";
    const float status_width = ImGui::CalcTextSize(status.c_str()).x;
    const float padding = ImGui::GetStyle().WindowPadding.x;
    if (studio.file && studio.time.moves()) {
        const float line = ImGui::GetFontSize();
        const float others = 28.0F * line;
        show_timeline(studio, requests,
                      std::clamp(size.x - status_width - others, 6.0F * line, 26.0F * line));
    }
    if (studio.is_recording) {
        ImGui::TextColored({0.75F, 0.15F, 0.1F, 1.0F}, "%s",
                           fmt::format("\u25cf {:.1f} s", studio.recorded_s).c_str());
        ImGui::SameLine();
    }
    ImGui::AlignTextToFramePadding();
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(), size.x - status_width - padding));
    ImGui::TextDisabled("%s", status.c_str());
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void show_messages(Studio& studio, const PanelRequests& requests, const Area& area, float content_scale)
{
    constexpr double note_s = 5.0;
    std::erase_if(studio.messages, [](const Message& message) {
        return message.kind == Message::Kind::note && app::seconds_since(message.since) > note_s;
    });
    if (studio.work) {
        show_work(studio, requests, area, content_scale);
    }
    float y = area.y + 12.0F * content_scale;
    std::optional<std::string> closed;
    const float width = std::min(560.0F * content_scale, area.width - 24.0F * content_scale);
    for (const Message& message : studio.messages) {
        const bool is_problem = message.kind == Message::Kind::problem;
        ImGui::SetNextWindowPos({area.x + 12.0F * content_scale, y});
        ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {width, area.height});
        ImGui::SetNextWindowBgAlpha(0.95F);
        ImGui::PushStyleColor(ImGuiCol_WindowBg, is_problem ? ImVec4(0.45F, 0.13F, 0.09F, 1.0F)
                                                            : ImVec4(0.16F, 0.15F, 0.14F, 1.0F));
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.98F, 0.96F, 0.92F, 1.0F));
        ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(1.0F, 1.0F, 1.0F, 0.12F));
        ImGui::Begin(("message " + message.topic).c_str(), nullptr,
                     fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
        ImGui::PushTextWrapPos(width - 40.0F * content_scale);
        ImGui::TextUnformatted(message.text.c_str());
        ImGui::PopTextWrapPos();
        if (is_problem && ImGui::SmallButton("Close")) {
            closed = message.topic;
        }
        y += ImGui::GetWindowHeight() + 8.0F * content_scale;
        ImGui::End();
        ImGui::PopStyleColor(3);
    }
    if (closed) {
        studio.settle(*closed);
    }
}

void show_keys(Studio& studio, const Area& area, float content_scale)
{
    const float width = std::min(880.0F * content_scale, area.width - 16.0F);
    ImGui::SetNextWindowPos({area.x + 0.5F * area.width, area.y + 0.5F * area.height}, ImGuiCond_Always,
                            {0.5F, 0.5F});
    ImGui::SetNextWindowSize({width, 0.0F});
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {width, area.height - 16.0F});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("keys", &studio.shows_keys, fixed & ~ImGuiWindowFlags_NoScrollbar);
    const bool has_two_columns = width > 640.0F * content_scale;
    const size_t left_count = has_two_columns ? 2 : key_groups().size();
    if (ImGui::BeginTable("halves", has_two_columns ? 2 : 1)) {
        ImGui::TableNextColumn();
        for (size_t i = 0; i < key_groups().size(); ++i) {
            if (i == left_count) {
                ImGui::TableNextColumn();
            }
            show_key_group(key_groups()[i], content_scale);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace estampe::viewer
