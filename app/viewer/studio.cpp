// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>
#include <estampe/style.hpp>

#include "core/failure.hpp"
#include "core/file.hpp"
#include "features/common/style_tables.hpp"
#include "option_values.hpp"
#include "piped_scene.hpp"

namespace estampe::viewer {

void Resolution::drawn(double scale, double seconds)
{
    constexpr double step = 1.0 / 16.0;
    /// Share of the time between two pictures that drawing may take; the rest is for other work.
    constexpr double room = 0.9;
    if (seconds > wanted_s && slow_s_ == 0.0) {
        slow_s_ = seconds;
        return;
    }
    const double counts_s = slow_s_ > 0.0 ? std::min(slow_s_, seconds) : seconds;
    slow_s_ = seconds > wanted_s ? seconds : 0.0;
    // The new size assumes that the drawing time is proportional to the number of pixels. The time that does
    // not depend on pixels is balanced over several pictures.
    const double fitting = scale * std::sqrt(room * wanted_s / std::max(counts_s, 1e-4));
    const double next = std::clamp(std::floor(fitting / step) * step, least, 1.0);
    if (next < scale_ && counts_s > wanted_s) {
        scale_ = next;
        slow_s_ = 0.0;
    } else if (next > scale_) {
        // The new size would fit even if the whole drawing time were proportional to pixels, so the size does
        // not oscillate. In one step, the size grows to at most twice as many pixels.
        scale_ = std::min(next, std::max(scale_ + step, 1.4 * scale_));
    }
}

void Timeline::advance(double seconds)
{
    if (!is_playing || !moves()) {
        return;
    }
    time_s += seconds * speed;
    if (is_endless || (time_s >= 0.0 && time_s < length_s)) {
        return;
    }
    if (loops) {
        time_s -= length_s * std::floor(time_s / length_s);
    } else {
        time_s = std::clamp(time_s, 0.0, length_s);
        is_playing = false;
    }
}

void Timeline::seek(double moment_s)
{
    if (moves()) {
        time_s = is_endless ? std::max(moment_s, 0.0) : std::clamp(moment_s, 0.0, length_s);
    }
}

void Timeline::toggle_playing()
{
    if (!moves()) {
        return;
    }
    is_playing = !is_playing;
    if (is_playing && !is_endless && !loops && time_s >= length_s) {
        time_s = 0.0;
    }
}

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* remedy = "mend it, or remove it to begin anew";

Json to_json(const glm::dvec3& vector)
{
    return Json::array({vector.x, vector.y, vector.z});
}

double number_of(const Json& json)
{
    const double number = json.get<double>();
    constexpr double most = 1e15;
    if (!(std::abs(number) < most)) {
        throw Error("holds a number out of all bounds");
    }
    return number;
}

glm::dvec3 to_vector(const Json& json)
{
    if (json.size() != 3) {
        throw Error("holds a place that has not three numbers");
    }
    return {number_of(json.at(0)), number_of(json.at(1)), number_of(json.at(2))};
}

Bookmark to_bookmark(const Json& json)
{
    Bookmark bookmark{.name = json.at("name").get<std::string>()};
    bookmark.camera.eye = to_vector(json.at("eye"));
    bookmark.camera.target = to_vector(json.at("target"));
    bookmark.camera.up = to_vector(json.at("up"));
    bookmark.camera.vertical_fov_rad = glm::radians(number_of(json.at("fov_deg")));
    bookmark.camera.near_m = number_of(json.at("near_m"));
    if (json.contains("half_height_m")) {
        bookmark.camera.orthographic_half_height_m = number_of(json.at("half_height_m"));
    }
    if (json.contains("shift")) {
        bookmark.camera.shift = {number_of(json.at("shift").at(0)), number_of(json.at("shift").at(1))};
    }
    bookmark.time_s = number_of(json.at("time_s"));
    bookmark.animation = json.at("animation").get<Index>();
    return bookmark;
}

Json to_json(const Bookmark& bookmark)
{
    Json json;
    json["name"] = bookmark.name;
    json["eye"] = to_json(bookmark.camera.eye);
    json["target"] = to_json(bookmark.camera.target);
    json["up"] = to_json(bookmark.camera.up);
    json["fov_deg"] = glm::degrees(bookmark.camera.vertical_fov_rad);
    json["near_m"] = bookmark.camera.near_m;
    if (bookmark.camera.orthographic_half_height_m) {
        json["half_height_m"] = *bookmark.camera.orthographic_half_height_m;
    }
    if (bookmark.camera.shift != glm::dvec2(0.0)) {
        json["shift"] = {bookmark.camera.shift.x, bookmark.camera.shift.y};
    }
    json["time_s"] = bookmark.time_s;
    json["animation"] = bookmark.animation;
    return json;
}

} // namespace

std::filesystem::path bookmarks_path(const std::filesystem::path& scene)
{
    std::filesystem::path path = scene;
    path += ".views.json";
    return path;
}

std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 20U;
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) {
        return {};
    }
    const std::vector<std::byte> bytes = read_file(path, largest_bytes, scope);
    const auto* first = reinterpret_cast<const char*>(bytes.data());
    std::vector<Bookmark> bookmarks;
    try {
        const Json json = Json::parse(first, first + bytes.size());
        for (const Json& item : json.at("views")) {
            bookmarks.push_back(to_bookmark(item));
        }
    } catch (const nlohmann::json::exception&) {
        // The message of the JSON library would quote the file, which may be anything.
        throw Error("is no file of bookmarks", path.string(), remedy);
    } catch (const Error& error) {
        throw Error(error.what(), path.string(), remedy);
    }
    return bookmarks;
}

void save_bookmarks(const std::vector<Bookmark>& bookmarks, const std::filesystem::path& path)
{
    if (bookmarks.empty()) {
        std::error_code problem;
        std::filesystem::remove(path, problem);
        return;
    }
    Json json;
    json["views"] = Json::array();
    for (const Bookmark& bookmark : bookmarks) {
        json["views"].push_back(to_json(bookmark));
    }
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    write_file_atomically(path, std::as_bytes(std::span(text)));
}

namespace {

Style style_named(const std::string& name, const app::Confinement& confine)
{
    return name.empty() ? Style() : Style::load(name, app::style_scope(name, confine));
}

} // namespace

EditedStyle::EditedStyle(const std::string& name, Style style, app::Confinement confine)
    : confine_(std::move(confine)), name_(name), base_(style_named(name, confine_)), style_(std::move(style)),
      history_({name_, base_, style_})
{
}

bool EditedStyle::differs_from_file() const
{
    return style_named(name_, confine_).to_toml() != base_.to_toml();
}

void EditedStyle::load(const std::string& name)
{
    const Style style = style_named(name, confine_);
    history_.push({name, style, style});
    take(history_.now());
}

void EditedStyle::set(std::string_view assignment)
{
    style_.set(assignment);
    finish_change();
}

void EditedStyle::finish_change()
{
    ++revision_;
    if (style_.to_toml() != history_.now().style.to_toml()) {
        history_.push({name_, base_, style_});
    }
    finished_revision_ = revision_;
}

void EditedStyle::finish_change_if_any()
{
    if (revision_ != finished_revision_) {
        finish_change();
    }
}

void EditedStyle::take(const State& state)
{
    name_ = state.name;
    base_ = state.base;
    style_ = state.style;
    finished_revision_ = ++revision_;
}

void EditedStyle::undo()
{
    if (history_.can_undo()) {
        take(history_.undo());
    }
}

void EditedStyle::redo()
{
    if (history_.can_redo()) {
        take(history_.redo());
    }
}

void EditedStyle::save(const std::filesystem::path& path)
{
    const std::string text = style_.to_toml();
    write_file_atomically(path, std::as_bytes(std::span(text)));
    name_ = path.string();
    base_ = style_;
    history_.push({name_, base_, style_});
}

void Studio::say(Message::Kind kind, const std::string& topic, const std::string& text)
{
    settle(topic);
    constexpr size_t most = 4;
    messages.push_back({kind, topic, text});
    while (messages.size() > most) {
        messages.pop_front();
    }
}

void Studio::settle(const std::string& topic)
{
    std::erase_if(messages, [&](const Message& message) { return message.topic == topic; });
}

void Studio::attempt(const std::string& topic, const std::function<void()>& step)
{
    try {
        step();
        settle(topic);
    } catch (const std::exception&) {
        say(Message::Kind::problem, topic, message_of_caught());
    }
}

void Studio::store_bookmarks()
{
    if (app::is_piped(file->draw.scene)) {
        return; // A scene without a file has no place to store bookmarks
    }
    attempt("bookmarks", [this] { save_bookmarks(bookmarks, bookmarks_path(file->draw.scene)); });
}

void Studio::add_bookmark()
{
    if (!file) {
        return;
    }
    bookmarks.push_back({.name = fmt::format("View {}", bookmarks.size() + 1),
                         .camera = rig.camera(),
                         .time_s = time.time_s,
                         .animation = time.animation});
    bookmark = bookmarks.size() - 1;
    store_bookmarks();
    say(Message::Kind::note, "bookmark", bookmarks.back().name + " kept");
}

void Studio::go_to_bookmark(size_t index)
{
    bookmark = index;
    const Bookmark& to = bookmarks.at(index);
    rig.set_mode(CameraMode::orbit);
    rig.place(to.camera);
    if (file && to.animation < file->scene.animations.size()) {
        time.animation = to.animation;
        time.length_s = file->scene.animations[to.animation].duration_s;
        time.seek(to.time_s);
    }
}

void Studio::remove_bookmark(size_t index)
{
    bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(index));
    bookmark.reset();
    store_bookmarks();
}

void Studio::step_bookmark(int step)
{
    if (bookmarks.empty()) {
        return;
    }
    const auto count = static_cast<int>(bookmarks.size());
    const int now = bookmark ? static_cast<int>(*bookmark) : (step > 0 ? -1 : 0);
    go_to_bookmark(static_cast<size_t>((now + step + count) % count));
}

void Studio::step_up_axis()
{
    const UpAxis now = up.value_or(UpAxis::y);
    up = now == UpAxis::y ? UpAxis::z : now == UpAxis::z ? UpAxis::x : UpAxis::y;
    const char* const name = *up == UpAxis::z ? "z" : *up == UpAxis::x ? "x" : "y";
    say(Message::Kind::note, "up",
        fmt::format("{} of the file points up; --up {} does the same", name, name));
}

void Studio::step_preset(int step)
{
    std::vector<std::string> names = Style::presets();
    names.insert(names.begin(), ""); // The built-in style has an empty name
    const auto found = std::ranges::find(names, edited.name());
    const auto count = static_cast<std::ptrdiff_t>(names.size());
    const std::ptrdiff_t now = found == names.end() ? 0 : found - names.begin();
    attempt("style", [&] { edited.load(names.at(static_cast<size_t>((now + step + count) % count))); });
}

void Studio::toggle_comparison()
{
    if (comparison.other) {
        comparison.other.reset();
    } else {
        comparison.other = edited.style();
        say(Message::Kind::note, "compare", "the right side stays as it is; drag the bar");
    }
}

void Studio::save_terrain(const std::string& path)
{
    if (terrain->problem()) {
        say(Message::Kind::note, "saved", "not saved: " + terrain->problem()->text);
        return;
    }
    attempt("terrain file", [&] {
        const bool keeps_comments = terrain->save(path);
        say(Message::Kind::note, "saved",
            "wrote " + path + (keeps_comments ? "" : ", anew: its comments could not be kept"));
    });
}

bool Studio::is_at_terrain() const
{
    return terrain && shows_bars && shows_panel && tab == PanelTab::ground;
}

void Studio::turn_sun(const glm::dvec2& drag)
{
    light::LightStyle& light = edited.style().tables().light;
    constexpr float degrees_a_view = 180.0F;
    edited.style().tables().sun.by = light::SunBy::direction;
    if (file && !file->scene.lights.empty()) {
        light.source = light::LightSource::sun; // The style's sun replaces the scene's own lights
    }
    const float azimuth = light.sun_azimuth_deg + degrees_a_view * static_cast<float>(drag.x);
    light.sun_azimuth_deg = std::remainder(azimuth, 360.0F);
    light.sun_elevation_deg =
        std::clamp(light.sun_elevation_deg - degrees_a_view * static_cast<float>(drag.y), -10.0F, 90.0F);
    edited.changed();
}

} // namespace estampe::viewer
