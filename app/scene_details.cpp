// SPDX-License-Identifier: MIT
#include "scene_details.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "scene/up_axis.hpp"
#include "scene/visibility.hpp"
#include "style/names.hpp"

namespace estampe::app {
namespace {

using Json = nlohmann::ordered_json;

bool has_no_axis(const std::string& path)
{
    constexpr std::array<std::string_view, 3> without_axis{".obj", ".ply", ".stl"};
    return std::ranges::find(without_axis, lower_extension(path)) != without_axis.end();
}

bool looks_z_up(const Scene& scene, const std::string& path)
{
    return has_no_axis(path) && guess_up_axis(scene) == UpAxis::z;
}

void add_axis(SceneDetails& details, const Scene& scene, const std::string& path)
{
    details.json["up_axis_known"] = !has_no_axis(path);
    if (!has_no_axis(path)) {
        details.json["up_axis_guess"] = nullptr;
        return;
    }
    const std::optional<UpAxis> guess = guess_up_axis(scene);
    details.json["up_axis_guess"] = !guess ? Json() : Json(*guess == UpAxis::z ? "z" : "y");
    details.rows.emplace_back("up axis", guess == UpAxis::z
                                             ? "y, as read; the box looks z-up: draw with --up z"
                                         : guess == UpAxis::y ? "y, as read, and the box looks y-up"
                                                              : "y, as read; the format does not say");
}

void add_unit(SceneDetails& details, const Scene& scene, const std::string& path)
{
    details.json["unit_m"] = scene.file_unit_m ? Json(*scene.file_unit_m) : Json();
    details.rows.emplace_back("unit", scene.file_unit_m   ? fmt::format("{:.6g} m", *scene.file_unit_m)
                                      : has_no_axis(path) ? "not in the file; read as metres"
                                                          : "metres");
}

/// Returns a camera's own name, or the name of its node.
std::string camera_name(const Scene& scene, Index camera)
{
    const auto node =
        std::ranges::find_if(scene.nodes, [&](const Node& candidate) { return candidate.camera == camera; });
    const std::string& own = scene.cameras[camera].name;
    return own.empty() && node != scene.nodes.end() ? node->name : own;
}

void add_cameras(SceneDetails& details, const Scene& scene)
{
    details.json["camera_details"] = Json::array();
    for (Index i = 0; i < scene.cameras.size(); ++i) {
        const SceneCamera& camera = scene.cameras[i];
        const std::string name = camera_name(scene, i);
        const double fov_deg = glm::degrees(camera.vertical_fov_rad);
        details.json["camera_details"].push_back(
            {{"name", name},
             {"projection", camera.orthographic ? "orthographic" : "perspective"},
             {"vertical_fov_deg", camera.orthographic ? Json() : Json(fov_deg)},
             {"half_height_m", camera.orthographic ? Json(camera.half_height_m) : Json()},
             {"near_m", camera.near_m}});
        const std::string lens = camera.orthographic
                                     ? fmt::format("half height {:.4g} m", camera.half_height_m)
                                     : fmt::format("fov {:.4g} degrees", fov_deg);
        details.rows.emplace_back("camera",
                                  fmt::format("{}, {}, near {:.4g} m", in_quotes(name), lens, camera.near_m));
    }
}

void add_animations(SceneDetails& details, const Scene& scene)
{
    details.json["frames_per_s"] = scene.frames_per_s ? Json(*scene.frames_per_s) : Json();
    if (scene.frames_per_s) {
        details.rows.emplace_back("frame rate", fmt::format("{:.6g} fps", *scene.frames_per_s));
    }
    details.json["animation_details"] = Json::array();
    for (const Animation& animation : scene.animations) {
        const double rate = key_rate(animation);
        details.json["animation_details"].push_back({{"name", animation.name},
                                                     {"duration_s", animation.duration_s},
                                                     {"channels", animation.channels.size()},
                                                     {"keys_per_s", rate > 0.0 ? Json(rate) : Json()}});
        details.rows.emplace_back(
            "animation", fmt::format("{}, {:.3g} s{}", in_quotes(animation.name), animation.duration_s,
                                     rate > 0.0 ? fmt::format(", keys at {} fps", rate) : ""));
    }
}

const char* name_of(LightType type)
{
    switch (type) {
    case LightType::directional:
        return "directional";
    case LightType::point:
        return "point";
    case LightType::spot:
        return "spot";
    case LightType::ambient:
        return "ambient";
    }
    return "";
}

/// Adds the lights to the details: one entry per visible node that carries a light.
void add_lights(SceneDetails& details, const Scene& scene)
{
    constexpr size_t most_rows = 20;
    details.json["light_list"] = Json::array();
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!visible[i] || scene.nodes[i].light == no_index) {
            continue;
        }
        const Light& light = scene.lights[scene.nodes[i].light];
        const std::string& name = light.name.empty() ? scene.nodes[i].name : light.name;
        const bool is_in_lux = light.type == LightType::directional || light.type == LightType::ambient;
        details.json["light_list"].push_back({{"name", name},
                                              {"type", name_of(light.type)},
                                              {"intensity", light.intensity},
                                              {"color", {light.color.x, light.color.y, light.color.z}}});
        if (details.json["light_list"].size() <= most_rows) {
            details.rows.emplace_back("scene light",
                                      fmt::format("{}, {}, {:.4g} {}", in_quotes(name), name_of(light.type),
                                                  light.intensity, is_in_lux ? "lux" : "cd"));
        }
    }
    if (const size_t count = details.json["light_list"].size(); count > most_rows) {
        details.rows.emplace_back("scene light", fmt::format("and {} more", count - most_rows));
    }
}

void add_names(SceneDetails& details, const char* label, const char* key,
               const std::vector<std::string>& names)
{
    details.json[key] = names;
    if (!names.empty()) {
        details.rows.emplace_back(label, one_line(fmt::format("{}", fmt::join(names, ", "))));
    }
}

} // namespace

SceneDetails scene_details(const Scene& scene, const std::string& path)
{
    SceneDetails details;
    add_axis(details, scene, path);
    add_unit(details, scene, path);
    add_animations(details, scene);
    add_cameras(details, scene);
    add_lights(details, scene);
    add_names(details, "variants", "variants", scene.variants);
    add_names(details, "missing files", "missing_files", scene.missing_files);
    const std::vector<bool> visible = visible_nodes(scene);
    const auto hidden = std::ranges::count(visible, false);
    details.json["hidden_nodes"] = hidden;
    if (hidden > 0) {
        details.rows.emplace_back("hidden nodes", std::to_string(hidden));
    }
    return details;
}

void check_layer_name(const Scene& scene, const std::string& layer)
{
    std::vector<std::string> names{"paper", "wash",   "ink",       "hatch",  "lines",
                                   "smoke", "shadow", "occlusion", "clouds", "ground"};
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].mesh != no_index) {
            const std::string& name = scene.nodes[i].name;
            names.push_back(name.empty() ? fmt::format("object {}", i) : name);
        }
    }
    // Layer names are made unique with numbers: the second of two objects named "leaf" becomes "leaf 2".
    const size_t digits = layer.find_last_not_of("0123456789");
    const bool is_numbered = digits != std::string::npos && digits + 1 < layer.size() && layer[digits] == ' ';
    const std::string unnumbered = is_numbered ? layer.substr(0, digits) : layer;
    if (std::ranges::any_of(names,
                            [&](const std::string& name) { return name == layer || name == unnumbered; })) {
        return;
    }
    const std::string meant = style::nearest(layer, names);
    throw Error(fmt::format("no layer or object is named {}", in_quotes(layer)), "--layer",
                meant.empty()
                    ? "layers are paper, wash, ink, hatch, lines, smoke, shadow, occlusion, clouds and the "
                      "names of objects"
                    : fmt::format("did you mean {}?", in_quotes(meant)));
}

std::vector<std::string> up_axis_notes(const Scene& scene, const std::string& path)
{
    if (!looks_z_up(scene, path)) {
        return {};
    }
    return {fmt::format("{}: its box looks z-up, and it is drawn y-up; --up z stands it upright", path)};
}

double key_rate(const Animation& animation)
{
    constexpr std::array rates{24.0, 25.0, 30.0, 60.0, 50.0, 12.0, 15.0, 120.0};
    constexpr size_t least_keys = 3;
    size_t most_keys = 0;
    for (const AnimationChannel& channel : animation.channels) {
        most_keys = std::max(most_keys, channel.times_s.size());
    }
    if (most_keys < least_keys) {
        return 0.0;
    }
    for (const double rate : rates) {
        const bool all_fit = std::ranges::all_of(animation.channels, [&](const AnimationChannel& channel) {
            return std::ranges::all_of(channel.times_s, [&](float time_s) {
                const double frame = rate * static_cast<double>(time_s);
                // Tolerance in frames for keys between two frames, because times of keys were rounded to
                // floats.
                constexpr double slack = 0.01;
                return std::abs(frame - std::round(frame)) <= slack;
            });
        });
        if (all_fit) {
            return rate;
        }
    }
    return 0.0;
}

} // namespace estampe::app
