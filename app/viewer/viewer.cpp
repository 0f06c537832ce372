// SPDX-License-Identifier: MIT
#include "viewer/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <imgui.h>

#include <backends/imgui_impl_glfw.h>

#include "core/file.hpp"
#include "gpu/shader_replacements.hpp"
#include "text.hpp"
#include "viewer/ground.hpp"
#include "viewer/jobs.hpp"
#include "viewer/texture_id.hpp"

namespace estampe::viewer {
namespace {

/// For so long after a change more of them are awaited before the picture is drawn whole.
constexpr double settling_s = 0.15;

bool same(const Camera& a, const Camera& b)
{
    return a.eye == b.eye && a.target == b.target && a.up == b.up &&
           a.vertical_fov_rad == b.vertical_fov_rad &&
           a.orthographic_half_height_m == b.orthographic_half_height_m && a.near_m == b.near_m;
}

bool same(const Sight& a, const Sight& b)
{
    return same(a.camera, b.camera) && a.style == b.style && a.time_s == b.time_s &&
           a.animation == b.animation && a.size_px == b.size_px && a.scene == b.scene &&
           a.has_other == b.has_other;
}

} // namespace

Viewer::Viewer(const app::ViewCommand& command)
    : command_(command), studio_(command.style_name, command.draw.style),
      pictures_(std::in_place, command.draw.device, &Window::wake), loader_(std::in_place, &Window::wake),
      window_(command.draw.width, command.draw.height), screen_(window_.handle(), command.draw.device.device),
      painter_(screen_)
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
    report(fmt::format("window {} x {}, scale {}", command.draw.width, command.draw.height, ui_scale_));
    if (!command.draw.scene.empty()) {
        open_scene(command.draw.scene);
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
        app::say(fmt::format("{:8.3f} {}\n", app::seconds_since(start_), text));
    }
}

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

void Viewer::open(const std::string& path)
{
    const std::string extension = lower_extension(path);
    std::error_code problem;
    if (extension == ".toml") {
        open_style(path);
    } else if (extension == ".tam" || extension == ".dds" || std::filesystem::is_directory(path, problem)) {
        studio_.attempt("style", [&] {
            Style style = studio_.look.style();
            style.set("hatch.strokes=map");
            style.set("hatch.map=\"" + path + "\"");
            studio_.look.style() = style;
            studio_.look.finish_change();
        });
    } else {
        open_scene(path);
    }
}

void Viewer::open_scene(const std::string& path)
{
    app::DrawOptions draw = command_.draw;
    if (path != command_.draw.scene) {
        draw.scene = path;
        draw.lightmap.clear();
        draw.camera = {};
        draw.animation.clear();
        draw.time_s = 0.0;
    }
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_.handle(), &width, &height);
    ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    const Area view = picture_area(studio_, ui_scale_);
    draw.width = static_cast<uint32_t>(view.width);
    draw.height = static_cast<uint32_t>(view.height);
    draw.style = studio_.look.style();
    loader_->load(std::move(draw));
    studio_.work = Work{"Reading " + std::filesystem::path(path).filename().string(), -1.0};
    report("reads " + path);
}

void Viewer::read_scene_again()
{
    if (studio_.file) {
        open_scene(studio_.file->draw.scene);
    }
}

void Viewer::open_style(const std::string& name)
{
    studio_.attempt("style", [&] { studio_.look.load(name); });
}

void Viewer::take_loaded()
{
    const std::optional<SceneLoader::Result> result = loader_->take();
    if (!result) {
        if (loader_->is_loading() && studio_.work) {
            studio_.work->share = loader_->share().value_or(-1.0);
        }
        return;
    }
    studio_.work.reset();
    if (const auto* problem = std::get_if<std::string>(&*result)) {
        take(Failure{Failure::Of::scene, *problem});
        return;
    }
    const auto& file = std::get<std::shared_ptr<const LoadedFile>>(*result);
    pictures_->set_scene(file);
    report("has read " + file->draw.scene);
}

void Viewer::take(const Failure& failure)
{
    report("failure: " + failure.message);
    if (failure.what == Failure::Of::device ||
        (failure.what == Failure::Of::scene && !studio_.file && !command_.draw.scene.empty())) {
        throw Error(failure.message);
    }
    const char* topic = failure.what == Failure::Of::scene ? "scene"
                        : failure.what == Failure::Of::job ? "job"
                                                           : "picture";
    if (failure.what == Failure::Of::job) {
        studio_.work.reset();
    }
    if (failure.what != Failure::Of::picture) {
        asked_ = {}; // what was asked for meanwhile is gone
    }
    studio_.say(Message::Kind::problem, topic, failure.message);
}

void Viewer::take(const SceneTaken& taken)
{
    const bool is_same = studio_.file && studio_.file->draw.scene == taken.file->draw.scene;
    studio_.file = taken.file;
    studio_.settle("scene");
    ++scene_number_;
    const Scene& scene = taken.file->scene;
    const std::string name = std::filesystem::path(taken.file->draw.scene).filename().string();
    scene_watch_.watch(files_of_scene(taken.file->draw.scene));
    if (!is_same) {
        // Made when someone walks; a scene that stands still is enough.
        auto ground = std::make_shared<std::optional<Ground>>();
        studio_.rig.set_scene(taken.file->home, taken.file->bounds,
                              [file = taken.file, ground](const glm::dvec3& place) {
                                  if (!*ground) {
                                      ground->emplace(file->scene);
                                  }
                                  return (*ground)->height_under(place);
                              });
        studio_.time = {.time_s = taken.file->draw.time_s, .animation = taken.file->animation};
        studio_.bookmark.reset();
        studio_.attempt("bookmarks",
                        [&] { studio_.bookmarks = load_bookmarks(bookmarks_path(taken.file->draw.scene)); });
        window_.set_title(name + " - Estampe");
    } else if (studio_.time.animation >= scene.animations.size()) {
        studio_.time.animation = taken.file->animation;
    }
    studio_.time.length_s =
        scene.animations.empty() ? 0.0 : scene.animations.at(studio_.time.animation).duration_s;
    if (!scene.warnings.empty()) {
        studio_.say(Message::Kind::note, "warnings", scene.warnings.front());
    }
    report("shows " + taken.file->draw.scene);
}

void Viewer::take(Picture& picture)
{
    textures_.at(picture.slot)->set(picture.image.width, picture.image.height, picture.image.rgba);
    shown_view_.at(picture.slot) = picture.view;
    const bool is_whole = picture.scale == 1.0 && picture.continuity == Continuity::still;
    if (picture.slot == 0) {
        studio_.shown_scale = picture.scale;
        studio_.shown_px = {picture.image.width, picture.image.height};
        studio_.shown_s = picture.seconds;
        studio_.is_refined = is_whole && picture.view == view_;
        studio_.passes = std::move(picture.timings);
        constexpr size_t most_times = 120;
        studio_.frame_ms.push_back(static_cast<float>(1e3 * picture.seconds));
        if (studio_.frame_ms.size() > most_times) {
            studio_.frame_ms.pop_front();
        }
        if (picture.view > 0 && (!is_whole || studio_.resolution.scale() == 1.0)) {
            studio_.resolution.drawn(picture.scale, picture.seconds);
        }
    }
    studio_.settle("picture");
    report(fmt::format("picture {} of view {}: {} x {}, {:.0f} %, {:.0f} ms{}", picture.slot, picture.view,
                       picture.image.width, picture.image.height, 100.0 * picture.scale,
                       1e3 * picture.seconds, is_whole && picture.view == view_ ? ", refined" : ""));
}

void Viewer::take_news()
{
    for (PictureNews& news : pictures_->take_news()) {
        frames_to_paint_ = std::max(frames_to_paint_, 1);
        if (auto* picture = std::get_if<Picture>(&news)) {
            take(*picture);
        } else if (const auto* failure = std::get_if<Failure>(&news)) {
            take(*failure);
        } else if (const auto* taken = std::get_if<SceneTaken>(&news)) {
            take(*taken);
        } else if (const auto* device = std::get_if<DeviceOpened>(&news)) {
            studio_.device = device->name;
        } else if (const auto* job = std::get_if<JobNews>(&news)) {
            if (job->is_done) {
                studio_.work.reset();
                asked_ = {}; // what is seen is drawn again
                studio_.say(Message::Kind::note, "job", job->text);
                report(job->text);
            } else {
                studio_.work = Work{job->text, job->share};
            }
        }
    }
}

Sight Viewer::sight() const
{
    return {.camera = studio_.rig.camera(),
            .style = studio_.look.revision(),
            .time_s = studio_.time.time_s,
            .animation = studio_.time.animation,
            .size_px = studio_.view_px,
            .scene = scene_number_,
            .has_other = studio_.comparison.other.has_value()};
}

void Viewer::request(size_t slot, const Sight& sight, bool is_moving)
{
    const double scale = is_moving ? studio_.resolution.scale() : 1.0;
    const auto scaled = [&](uint32_t px) {
        return std::max(static_cast<uint32_t>(std::lround(scale * px)), 1U);
    };
    PictureRequest request{.camera = sight.camera,
                           .style = slot == 0 ? studio_.look.style() : *studio_.comparison.other,
                           .settings = {.width = scaled(sight.size_px.x),
                                        .height = scaled(sight.size_px.y),
                                        .samples = is_moving ? 1 : studio_.samples,
                                        .time_s = sight.time_s,
                                        .animation = sight.animation},
                           .scale = scale,
                           .view = view_};
    // What moves in one style is drawn as a film is, so that its lines do not jump.
    if (is_moving && scale < 1.0 && !sight.has_other && style_drawn_ == sight.style) {
        request.settings.continuity = Continuity::follows;
    }
    style_drawn_ = sight.style;
    requested_view_.at(slot) = view_;
    requested_whole_.at(slot) = scale == 1.0;
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
        if (is_moving_ && !is_asked) {
            request(slot, now, true);
        } else if (!is_moving_ && !(is_asked && requested_whole_.at(slot))) {
            request(slot, now, false);
        }
    }
}

void Viewer::move_by_keys(double seconds)
{
    studio_.time.advance(seconds);
    if (studio_.rig.mode() == CameraMode::orbit) {
        return;
    }
    const auto axis = [this](int less, int more) {
        return (window_.is_down(more) ? 1.0 : 0.0) - (window_.is_down(less) ? 1.0 : 0.0);
    };
    const glm::dvec3 way(axis(GLFW_KEY_A, GLFW_KEY_D), axis(GLFW_KEY_C, GLFW_KEY_E),
                         axis(GLFW_KEY_S, GLFW_KEY_W));
    if (way != glm::dvec3(0.0)) {
        constexpr double longest_s = 0.2; // a stall is no leap
        studio_.rig.go(way, std::min(seconds, longest_s),
                       window_.is_down(GLFW_KEY_LEFT_SHIFT) || window_.is_down(GLFW_KEY_RIGHT_SHIFT));
    }
}

void Viewer::drag(const glm::dvec2& way, const PointerEvent& event, const Area& area)
{
    switch (drag_) {
    case Drag::turn:
        studio_.rig.turn(way);
        break;
    case Drag::pan:
        studio_.rig.pan(way);
        break;
    case Drag::zoom:
        studio_.rig.zoom(-20.0 * way.y);
        break;
    case Drag::sun:
        studio_.turn_sun(way);
        break;
    case Drag::split:
        studio_.comparison.split =
            std::clamp((static_cast<float>(event.place.x) - area.x) / area.width, 0.02F, 0.98F);
        break;
    case Drag::none:
        break;
    }
}

void Viewer::press(const PointerEvent& event, const Area& area)
{
    const double split_x = area.x + area.width * studio_.comparison.split;
    const bool is_on_split = studio_.comparison.other && std::abs(event.place.x - split_x) < 8.0 * ui_scale_;
    switch (event.button) {
    case GLFW_MOUSE_BUTTON_LEFT:
        drag_ = is_on_split                               ? Drag::split
                : window_.is_down(GLFW_KEY_L)             ? Drag::sun
                : (event.modifiers & GLFW_MOD_SHIFT) != 0 ? Drag::pan
                                                          : Drag::turn;
        break;
    case GLFW_MOUSE_BUTTON_RIGHT:
        drag_ = Drag::zoom;
        break;
    case GLFW_MOUSE_BUTTON_MIDDLE:
        drag_ = Drag::pan;
        break;
    default:
        break;
    }
}

void Viewer::follow_pointer(const std::vector<PointerEvent>& events)
{
    const Area area = picture_area(studio_, ui_scale_);
    for (const PointerEvent& event : events) {
        const glm::dvec2 way = (event.place - pointer_) / static_cast<double>(area.height);
        pointer_ = event.place;
        const bool is_in_picture = event.place.x >= area.x && event.place.x < area.x + area.width &&
                                   event.place.y >= area.y && event.place.y < area.y + area.height;
        const bool is_free = is_in_picture && !ImGui::GetIO().WantCaptureMouse && studio_.file;
        switch (event.kind) {
        case PointerEvent::Kind::press:
            if (drag_ == Drag::none && is_free) {
                press(event, area);
            }
            break;
        case PointerEvent::Kind::release:
            if (drag_ == Drag::sun) {
                studio_.look.finish_change();
            }
            drag_ = Drag::none;
            break;
        case PointerEvent::Kind::move:
            drag(way, event, area);
            break;
        case PointerEvent::Kind::wheel:
            if (is_free) {
                studio_.rig.zoom(event.wheel);
            }
            break;
        }
    }
}

void Viewer::look_at_files()
{
    constexpr double between_looks_s = 0.1;
    if (app::seconds_since(looked_at_files_) < between_looks_s) {
        return;
    }
    looked_at_files_ = app::Clock::now();
    if (studio_.look.name() != watched_style_) {
        watched_style_ = studio_.look.name();
        style_watch_.watch(watched_style_.ends_with(".toml")
                               ? std::vector<std::filesystem::path>{watched_style_}
                               : std::vector<std::filesystem::path>{});
    }
    if (!style_watch_.changed().empty()) {
        report("style changed: " + watched_style_);
        studio_.attempt("style", [this] {
            // What was saved from here is in hand already.
            if (Style::load(watched_style_).to_toml() != studio_.look.base().to_toml()) {
                studio_.look.load(watched_style_);
            }
        });
    }
    if (!scene_watch_.changed().empty() && studio_.file) {
        report("scene changed");
        read_scene_again();
    }
}

void Viewer::take_shaders()
{
    if (!shaders_) {
        return;
    }
    for (ShaderNews& news : shaders_->take()) {
        const std::string topic = "shader " + news.name;
        if (news.problem.empty()) {
            gpu::replace_shader(news.name, std::move(news.spirv));
            studio_.settle(topic);
            studio_.settle("picture");
            studio_.look.changed(); // all is drawn anew
            report(topic + " compiled");
        } else {
            studio_.say(Message::Kind::problem, topic, news.problem);
            report(topic + ": " + news.problem);
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
                           .style = studio_.look.style(),
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
    pictures_->do_job(
        std::make_unique<FilmJob>(std::move(take_), settings, free_name(studio_.file->draw.scene, ".mp4")));
    take_ = {};
}

void Viewer::record()
{
    if (!take_style_ || take_revision_ != studio_.look.revision()) {
        take_revision_ = studio_.look.revision();
        take_style_ = std::make_shared<const Style>(studio_.look.style());
    }
    studio_.recorded_s = app::seconds_since(take_start_);
    take_.add({.at_s = studio_.recorded_s,
               .camera = studio_.rig.camera(),
               .time_s = studio_.time.time_s,
               .animation = studio_.time.animation,
               .style = take_style_});
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

void Viewer::run()
{
    constexpr double idle_s = 0.25;
    constexpr double busy_s = 0.03;
    constexpr double frame_s = 1.0 / 60.0; // no more often, whatever the pointer does
    app::Clock::time_point last = app::Clock::now();
    app::Clock::time_point painted = last;
    while (!window_.is_closing()) {
        const bool is_busy = is_moving_ || studio_.is_recording || studio_.work ||
                             !studio_.messages.empty() || frames_to_paint_ > 0;
        const double since_s = app::seconds_since(painted);
        const double wait_s = frames_to_paint_ > 0 ? std::max(frame_s - since_s, 0.0)
                              : is_busy            ? busy_s
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
        move_by_keys(app::seconds_since(last));
        last = app::Clock::now();
        if (studio_.is_recording) {
            record();
        }
        ask_for_pictures();
        if (studio_.work || !studio_.messages.empty()) {
            frames_to_paint_ = std::max(frames_to_paint_, app::seconds_since(painted) > 0.1 ? 1 : 0);
        }
        if (frames_to_paint_ > 0 && app::seconds_since(painted) >= frame_s) {
            paint();
            ask_for_pictures(); // what panels and pointer changed
            painted = app::Clock::now();
            --frames_to_paint_;
        }
    }
    report("closes");
}

} // namespace estampe::viewer
