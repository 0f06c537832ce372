// SPDX-License-Identifier: MIT
// The loop of the viewer's window: requests pictures, and paints the window.
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "options.hpp"
#include "viewer/picture_thread.hpp"
#include "viewer/terrain_edit.hpp"
#include "viewer/ui_painter.hpp"

namespace estampe::viewer {
namespace {

/// Delay after a change of the view before the picture is drawn in full, because more changes may follow.
constexpr double settling_s = 0.15;

bool same(const Sight& a, const Sight& b)
{
    return a.camera == b.camera && a.style == b.style && a.time_s == b.time_s && a.animation == b.animation &&
           a.size_px == b.size_px && a.scene == b.scene && a.terrain == b.terrain &&
           a.has_other == b.has_other && a.times_passes == b.times_passes;
}

} // namespace

Viewer::Viewer(const app::ViewCommand& command)
    : command_(command), warm_up_(command),
      studio_(command.style_name, command.draw.style, command.draw.confine),
      pictures_(std::in_place, command.draw.device, &Window::wake), loader_(std::in_place, &Window::wake),
      window_(command.draw.page.width, command.draw.page.height),
      screen_(window_.handle(), command.draw.device.device), painter_(screen_)
{
    studio_.samples = command.draw.samples;
    requests_ = {.act = [this](Action action) { act(action); },
                 .open_style = [this](const std::string& name) { open_style(name); },
                 .cancel_work = [this] { go_back(); }};
    for (auto& texture : textures_) {
        texture = painter_.make_texture();
    }
    apply_scale();
    if (!command.shaders.empty()) {
        shaders_.emplace(command.shaders, &Window::wake);
    }
    report(fmt::format("window {} x {}, scale {}", command.draw.page.width, command.draw.page.height,
                       ui_scale_));
    if (warm_up_.is_quick()) {
        report("shaders are compiled quickly");
    }
    if (!command.draw.scene.empty()) {
        open_scene(command.draw.scene, command.draw.terrain);
    }
}

Viewer::~Viewer()
{
    shaders_.reset();
    loader_.reset();
    pictures_.reset();
}

void Viewer::report(const std::string& text) const
{
    if (command_.verbose) {
        say(fmt::format("{:8.3f} {}\n", app::seconds_since(start_), text));
    }
}

void Viewer::open(const std::string& path)
{
    const std::string extension = lower_extension(path);
    std::error_code problem;
    if (extension == ".toml") {
        is_terrain(path) ? open_terrain(path) : open_style(path);
    } else if (extension == ".tam" || extension == ".dds" || std::filesystem::is_directory(path, problem)) {
        studio_.attempt("style", [&] {
            Style style = studio_.edited.style();
            style.set("hatch.strokes=map");
            style.set("hatch.map=" + path);
            studio_.edited.style() = style;
            studio_.edited.finish_change();
        });
    } else {
        open_scene(path, studio_.file ? studio_.file->draw.terrain : command_.draw.terrain);
    }
}

void Viewer::open_terrain(const std::string& path)
{
    if (!studio_.file || studio_.file->scene.meshes.empty()) {
        open_scene(path, "");
    } else if (studio_.terrain) {
        studio_.attempt("terrain file", [&] { studio_.terrain->load(path); });
    } else {
        open_scene(studio_.file->draw.scene, path);
    }
}

void Viewer::open_scene(const std::string& path, const std::string& terrain)
{
    if (!studio_.file || path != studio_.file->draw.scene) {
        studio_.up = path == command_.draw.scene ? command_.draw.load.up : std::nullopt;
    }
    app::DrawOptions draw = command_.draw;
    draw.terrain = terrain;
    draw.load.up = studio_.up;
    if (path != command_.draw.scene) {
        draw.scene = path;
        draw.input_format.clear();
        draw.lightmap.clear();
        draw.camera = {};
        draw.animation.clear();
        draw.load.variant.clear();
        draw.time_s = 0.0;
    }
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_.handle(), &width, &height);
    ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    const Area view = picture_area(studio_, ui_scale_);
    draw.page.width = static_cast<uint32_t>(view.width);
    draw.page.height = static_cast<uint32_t>(view.height);
    draw.style = studio_.edited.style();
    loader_->load(std::move(draw));
    studio_.work = Work{"Reading " + std::filesystem::path(path).filename().string(), -1.0};
    report("reads " + path);
}

void Viewer::read_scene_again()
{
    if (studio_.file) {
        const app::DrawOptions& draw = studio_.file->draw;
        open_scene(draw.scene,
                   draw.terrain.empty() || !studio_.terrain ? draw.terrain : studio_.terrain->name());
    }
}

void Viewer::open_style(const std::string& name)
{
    studio_.attempt("style", [&] { studio_.edited.load(name); });
}

Sight Viewer::sight() const
{
    return {.camera = studio_.rig.camera(),
            .style = studio_.edited.revision(),
            .time_s = studio_.time.time_s,
            .animation = studio_.time.animation,
            .size_px = studio_.view_px,
            .scene = scene_number_,
            .terrain = terrain_sent_,
            .has_other = studio_.comparison.other.has_value(),
            .times_passes = studio_.shows_panel && studio_.tab == PanelTab::timings};
}

void Viewer::request(size_t slot, const Sight& sight, bool is_moving)
{
    const double scale = is_moving ? studio_.resolution.scale() : 1.0;
    const auto scaled = [&](uint32_t px) {
        return std::max(static_cast<uint32_t>(std::lround(scale * px)), 1U);
    };
    const app::ChosenStyle chosen{studio_.edited.style(), studio_.edited.base()};
    const Style& other = studio_.comparison.other.value_or(chosen.style);
    PictureRequest request{.camera = sight.camera,
                           .style = slot == 0 ? chosen : app::ChosenStyle{other, other},
                           .settings = {.width = scaled(sight.size_px.x),
                                        .height = scaled(sight.size_px.y),
                                        .samples = is_moving ? 1 : studio_.samples,
                                        .time_s = sight.time_s,
                                        .animation = sight.animation,
                                        .time_passes = sight.times_passes},
                           .scale = scale,
                           .view = view_};
    // Consecutive pictures in one style are drawn as frames of a film. Lines then do not jump, and flowing
    // ink continues from picture to picture.
    const bool flows = request.style.style.tables().ink.enabled || (is_moving && studio_.file->visit);
    if ((flows || (is_moving && scale < 1.0)) && !sight.has_other && style_drawn_ == sight.style) {
        request.settings.continuity = Continuity::follows;
    }
    style_drawn_ = sight.style;
    requested_view_.at(slot) = view_;
    requested_whole_.at(slot) = !is_moving || (scale == 1.0 && studio_.samples == 1);
    pictures_->draw(slot, std::move(request));
}

void Viewer::ask_for_pictures()
{
    if (!studio_.file || studio_.view_px.x == 0) {
        return;
    }
    const Sight now = sight();
    if (!same(now, asked_)) {
        asked_ = now;
        ++view_;
        changed_ = app::Clock::now();
        studio_.is_refined = false;
    }
    is_moving_ = app::seconds_since(changed_) < settling_s || studio_.time.is_playing || drag_ != Drag::none;
    for (size_t slot = 0; slot < (now.has_other ? 2U : 1U); ++slot) {
        const bool is_asked = requested_view_.at(slot) == view_;
        // A picture in full size may take minutes, so it is requested only after a quick, small picture is
        // shown.
        if (!is_asked) {
            request(slot, now, true);
        } else if (!is_moving_ && answered_view_.at(slot) == view_ && !requested_whole_.at(slot)) {
            request(slot, now, false);
        }
    }
}

void Viewer::take_screenshot()
{
    if (!studio_.file) {
        return;
    }
    const Sight now = sight();
    PictureRequest request{.camera = now.camera,
                           .style = {studio_.edited.style(), studio_.edited.base()},
                           .settings = {.width = now.size_px.x,
                                        .height = now.size_px.y,
                                        .samples = studio_.samples,
                                        .time_s = now.time_s,
                                        .animation = now.animation}};
    pictures_->do_job(
        std::make_unique<ScreenshotJob>(std::move(request), free_name(studio_.file->draw.scene, ".png")));
}

void Viewer::toggle_recording()
{
    if (!studio_.file || studio_.work) {
        return;
    }
    studio_.is_recording = !studio_.is_recording;
    if (studio_.is_recording) {
        take_ = {};
        take_start_ = app::Clock::now();
        take_style_.reset();
        return;
    }
    record();
    const RenderSettings settings{
        .width = studio_.view_px.x, .height = studio_.view_px.y, .samples = studio_.samples};
    // A film with transparency needs a format with alpha, which H.264 lacks.
    const bool has_alpha = app::is_transparent(studio_.edited.style());
    pictures_->do_job(
        std::make_unique<FilmJob>(std::move(take_), studio_.file, end_s_, settings,
                                  free_name(studio_.file->draw.scene, has_alpha ? ".webm" : ".mp4")));
    take_ = {};
}

void Viewer::record()
{
    if (!take_style_ || take_revision_ != studio_.edited.revision()) {
        take_revision_ = studio_.edited.revision();
        take_style_ = std::make_shared<const app::ChosenStyle>(
            app::ChosenStyle{studio_.edited.style(), studio_.edited.base()});
    }
    studio_.recorded_s = app::seconds_since(take_start_);
    take_.add({.at_s = studio_.recorded_s,
               .camera = studio_.rig.camera(),
               .time_s = studio_.time.time_s,
               .animation = studio_.time.animation,
               .style = take_style_});
}

void Viewer::run()
{
    constexpr double idle_s = 0.25;
    constexpr double busy_s = 0.03;
    // Shortest time between two frames of the window, whatever the pointer does.
    constexpr double frame_s = 1.0 / 60.0;
    app::Clock::time_point last = app::Clock::now();
    app::Clock::time_point painted = last;
    while (!window_.is_closing()) {
        const bool is_seen = !window_.is_minimised();
        if (has_pointer_ && !window_.has_focus()) {
            take_pointer(false);
        }
        const bool is_busy = is_moving_ || is_on_foot() || studio_.is_recording || studio_.work ||
                             !studio_.messages.empty() || frames_to_paint_ > 0;
        const double since_s = app::seconds_since(painted);
        const double wait_s = !is_seen               ? idle_s
                              : frames_to_paint_ > 0 ? std::max(frame_s - since_s, 0.0)
                              : is_busy              ? busy_s
                                                     : idle_s;
        const WindowEvents events = window_.wait(wait_s);
        for (const Action action : events.actions) {
            act(action);
        }
        for (const std::string& path : events.dropped) {
            open(path);
        }
        if (events.any) {
            frames_to_paint_ = 3;
        }
        follow_pointer(events.pointer);
        take_loaded();
        take_news();
        take_shaders();
        look_at_files();
        send_terrain();
        move_by_keys(app::seconds_since(last));
        last = app::Clock::now();
        if (studio_.is_recording) {
            record();
        }
        if (!is_seen) {
            continue;
        }
        ask_for_pictures();
        if (studio_.work || !studio_.messages.empty()) {
            frames_to_paint_ = std::max(frames_to_paint_, app::seconds_since(painted) > 0.1 ? 1 : 0);
        }
        if (frames_to_paint_ > 0 && app::seconds_since(painted) >= frame_s) {
            paint();
            send_terrain();
            // Pictures are requested again, because panels and pointer may have changed the view.
            ask_for_pictures();
            painted = app::Clock::now();
            --frames_to_paint_;
        }
    }
    report("closes");
}

namespace {

/// Returns whether ImGui still holds input. From version 1.87 on, ImGui processes quickly typed keys one per
/// frame, so more frames must be painted.
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
        // The picture keeps the view's height; at another aspect ratio it is centred and cropped.
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
        return; // Nothing to paint, because the window is minimised
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
