// SPDX-License-Identifier: MIT
#include <array>
#include <filesystem>

#include <imgui.h>

#include "viewer/panels.hpp"

namespace estampe::viewer {
namespace {

constexpr float text_points = 14.0F;

/// Plain sans-serif fonts where distributions put them; without any ImGui's own is taken.
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
    // Latin, dashes, arrows and signs that panels use.
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

} // namespace estampe::viewer
