// SPDX-License-Identifier: MIT
#include "viewer/studio.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "features/common/style_tables.hpp"
#include "piped_scene.hpp"

namespace estampe::viewer {

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
    } catch (const std::exception& problem) {
        say(Message::Kind::problem, topic, problem.what());
    }
}

void Studio::store_bookmarks()
{
    if (app::is_piped(file->draw.scene)) {
        return; // there is no file to keep them beside
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
    std::vector<std::string> names{""};
    std::ranges::copy_if(Style::presets(), std::back_inserter(names),
                         [](const std::string& name) { return !name.starts_with("tam-"); });
    const auto found = std::ranges::find(names, look.name());
    const auto count = static_cast<std::ptrdiff_t>(names.size());
    const std::ptrdiff_t now = found == names.end() ? 0 : found - names.begin();
    attempt("style", [&] { look.load(names.at(static_cast<size_t>((now + step + count) % count))); });
}

void Studio::toggle_comparison()
{
    if (comparison.other) {
        comparison.other.reset();
    } else {
        comparison.other = look.style();
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
    light::LightStyle& light = look.style().tables().light;
    constexpr float degrees_a_view = 180.0F;
    look.style().tables().sun.by = light::SunBy::direction;
    if (file && !file->scene.lights.empty()) {
        light.source = light::LightSource::sun; // the scene's own are out
    }
    const float azimuth = light.sun_azimuth_deg + degrees_a_view * static_cast<float>(drag.x);
    light.sun_azimuth_deg = std::remainder(azimuth, 360.0F);
    light.sun_elevation_deg =
        std::clamp(light.sun_elevation_deg - degrees_a_view * static_cast<float>(drag.y), -10.0F, 90.0F);
    look.changed();
}

} // namespace estampe::viewer
