// SPDX-License-Identifier: MIT
// What the window looks like.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

#include <backends/imgui_impl_glfw.h>

#include "viewer/texture_id.hpp"

namespace estampe::viewer {
namespace {

/// From version 1.87 on Dear ImGui takes quick typing a key a frame: what is left needs frames of its own.
bool has_input_left()
{
#if IMGUI_VERSION_NUM >= 18700
    return !ImGui::GetCurrentContext()->InputEventsQueue.empty();
#else
    return false;
#endif
}

} // namespace

void Viewer::apply_scale()
{
    int window_width = 0;
    int pixel_width = 0;
    int height = 0;
    glfwGetWindowSize(window_.handle(), &window_width, &height);
    glfwGetFramebufferSize(window_.handle(), &pixel_width, &height);
    const float pixels_a_unit =
        window_width > 0 ? static_cast<float>(pixel_width) / static_cast<float>(window_width) : 1.0F;
    const float scale = std::clamp(window_.content_scale() / std::max(pixels_a_unit, 0.1F), 0.5F, 4.0F);
    if (scale != ui_scale_) {
        ui_scale_ = scale;
        apply_theme(scale);
        painter_.update_fonts();
    }
}

void Viewer::paint_pictures(const Area& area)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 least{area.x, area.y};
    const ImVec2 most{area.x + area.width, area.y + area.height};
    const float split_x = std::round(area.x + area.width * studio_.comparison.split);
    for (size_t slot = 0; slot < 2; ++slot) {
        const Texture& texture = *textures_.at(slot);
        if (texture.empty() || (slot == 1 && !studio_.comparison.other)) {
            continue;
        }
        // A view holds its height: of another size than the area it is centred and cut.
        const float width =
            area.height * static_cast<float>(texture.width()) / static_cast<float>(texture.height());
        const bool fits = std::abs(width - area.width) < 0.02F * area.width;
        const float x = fits ? area.x : area.x + 0.5F * (area.width - width);
        list.PushClipRect({slot == 1 ? split_x : least.x, least.y},
                          {slot == 0 && studio_.comparison.other ? split_x : most.x, most.y});
        list.AddImage(id_of(texture), {x, area.y}, {x + (fits ? area.width : width), most.y});
        list.PopClipRect();
    }
    if (studio_.comparison.other) {
        const float half = std::max(1.0F, ui_scale_);
        list.AddRectFilled({split_x - half, least.y}, {split_x + half, most.y}, IM_COL32(30, 28, 26, 220));
        const float middle = area.y + 0.5F * area.height;
        list.AddCircleFilled({split_x, middle}, 9.0F * ui_scale_, IM_COL32(30, 28, 26, 255), 24);
        const float text_y = area.y + 10.0F * ui_scale_;
        list.AddText({split_x - 22.0F * ui_scale_, text_y}, IM_COL32(30, 28, 26, 220), "A");
        list.AddText({split_x + 13.0F * ui_scale_, text_y}, IM_COL32(30, 28, 26, 220), "B");
    }
    if (!studio_.file && !studio_.work) {
        const char* hint = "Drop a scene here: glTF, OBJ, PLY, STL, FBX, DAE";
        const ImVec2 size = ImGui::CalcTextSize(hint);
        list.AddText({area.x + 0.5F * (area.width - size.x), area.y + 0.5F * area.height},
                     IM_COL32(60, 57, 52, 255), hint);
    }
}

void Viewer::lay_out()
{
    apply_scale();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const Area area = picture_area(studio_, ui_scale_);
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    studio_.view_px = {static_cast<uint32_t>(std::lround(area.width * pixels.x)),
                       static_cast<uint32_t>(std::lround(area.height * pixels.y))};
    paint_pictures(area);
    if (studio_.shows_bars) {
        show_bar(studio_, requests_, ui_scale_);
        if (studio_.shows_panel) {
            show_panel(studio_, requests_, ui_scale_);
        }
    }
    show_messages(studio_, requests_, area, ui_scale_);
    if (studio_.shows_keys) {
        show_keys(studio_, area, ui_scale_);
    }
    ImGui::Render();
    if (has_input_left()) {
        frames_to_paint_ = 3;
    }
}

void Viewer::paint()
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_.handle(), &width, &height);
    if (width == 0 || height == 0) {
        return; // minimised
    }
    lay_out();
    const std::optional<Screen::Frame> frame = screen_.begin();
    if (!frame) {
        return;
    }
    painter_.record_upload(frame->commands);
    for (const auto& texture : textures_) {
        texture->record_upload(frame->commands);
    }
    screen_.begin_drawing(*frame);
    painter_.paint(*ImGui::GetDrawData(), frame->commands);
    screen_.end(*frame);
    if (!has_painted_picture_ && !textures_[0]->empty()) {
        has_painted_picture_ = true;
        report("window with a picture");
    }
}

} // namespace estampe::viewer
