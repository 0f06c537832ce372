// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe {
namespace {

constexpr const char* camera_form =
    "write \"eye=x,y,z target=x,y,z fov=degrees\", and if need be up=x,y,z or "
    "ortho=half_height";

[[noreturn]] void refuse(const std::string& text, const std::string& what)
{
    throw Error(what, fmt::format("camera \"{}\"", text), camera_form);
}

using Settings = std::map<std::string, std::string, std::less<>>;

Settings split_settings(const std::string& text)
{
    Settings settings;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos)
            refuse(text, fmt::format("\"{}\" is not of the form key=value", word));
        const std::string key = word.substr(0, equals);
        if (key != "eye" && key != "target" && key != "fov" && key != "up" && key != "ortho")
            refuse(text, fmt::format("unknown key \"{}\"", key));
        if (!settings.emplace(key, word.substr(equals + 1)).second)
            refuse(text, fmt::format("\"{}\" is given twice", key));
    }
    return settings;
}

double parse_number(const std::string& text, const std::string& key, std::string_view digits)
{
    if (digits.starts_with('+'))
        digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !(std::abs(value) <= 1e12))
        refuse(text, fmt::format("{}: \"{}\" is not a number up to 1e12", key, digits));
    return value;
}

glm::dvec3 parse_vector(const std::string& text, const std::string& key, std::string_view list)
{
    glm::dvec3 vector{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const size_t comma = list.find(',');
        if ((comma == std::string_view::npos) != (axis == 2))
            refuse(text, fmt::format("{} needs three numbers, x,y,z", key));
        vector[axis] = parse_number(text, key, list.substr(0, comma));
        list.remove_prefix(axis == 2 ? list.size() : comma + 1);
    }
    return vector;
}

bool parallel(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

void parse_lens(const std::string& text, const Settings& settings, Camera& camera)
{
    if (const auto fov = settings.find("fov"); fov != settings.end()) {
        const double degrees = parse_number(text, "fov", fov->second);
        if (degrees < 1.0 || degrees > 170.0)
            refuse(text, "fov must be from 1 to 170 degrees");
        camera.vertical_fov_rad = glm::radians(degrees);
    }
    if (const auto ortho = settings.find("ortho"); ortho != settings.end()) {
        const double half_height_m = parse_number(text, "ortho", ortho->second);
        if (half_height_m <= 0.0)
            refuse(text, "ortho must be greater than zero");
        camera.orthographic_half_height_m = half_height_m;
    }
}

std::string list_cameras(const Scene& scene)
{
    if (scene.cameras.empty())
        return "the scene has no cameras: leave --camera out, or use auto";
    std::string list;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        list += fmt::format("{}{} \"{}\"", list.empty() ? "" : ", ", i, scene.cameras[i].name);
    return "cameras of the scene: " + list;
}

/// The camera of that name (its own or its node's), else the one of that number.
Index find_camera_node(const Scene& scene, const std::string& name)
{
    Index number = no_index;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc{} || end != name.data() + name.size())
        number = no_index;
    Index numbered = no_index;
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (node.camera >= scene.cameras.size())
            continue;
        if (!name.empty() && (scene.cameras[node.camera].name == name || node.name == name))
            return index;
        if (node.camera == number && numbered == no_index)
            numbered = index;
    }
    return numbered;
}

} // namespace

Camera parse_camera(const std::string& text)
{
    const Settings settings = split_settings(text);
    Camera camera;
    for (const char* key : {"eye", "target"})
        if (!settings.contains(key))
            refuse(text, fmt::format("\"{}\" is missing", key));
    camera.eye = parse_vector(text, "eye", settings.find("eye")->second);
    camera.target = parse_vector(text, "target", settings.find("target")->second);
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(view) <= 1e-9 * (1.0 + glm::length(camera.eye)))
        refuse(text, "eye and target are the same point");
    if (const auto up = settings.find("up"); up != settings.end()) {
        camera.up = parse_vector(text, "up", up->second);
        if (glm::length(camera.up) == 0.0 || parallel(camera.up, view))
            refuse(text, "up must not be zero, nor along the line from eye to target");
        camera.up = glm::normalize(camera.up);
    } else if (parallel(camera.up, view)) {
        camera.up = {0.0, 0.0, -1.0};
    }
    parse_lens(text, settings, camera);
    camera.near_m = std::max(1e-6, 1e-3 * glm::length(view));
    return camera;
}

Camera scene_camera(const Scene& scene, const ScenePose& pose, const std::string& name)
{
    const Index index = find_camera_node(scene, name);
    if (index == no_index)
        throw Error(fmt::format("no camera \"{}\"", name), scene.name, list_cameras(scene));
    const SceneCamera& lens = scene.cameras[scene.nodes[index].camera];
    const glm::dmat4& world_from_camera = pose.world_from_node[index];
    const glm::dvec3 back{world_from_camera[2]};
    const glm::dvec3 up{world_from_camera[1]};
    Camera camera;
    camera.eye = glm::dvec3(world_from_camera[3]);
    if (glm::length(back) == 0.0 || glm::length(up) == 0.0 || parallel(back, up))
        throw Error(fmt::format("the node of camera \"{}\" is scaled to nothing", name), scene.name,
                    "use --camera auto");
    camera.target = camera.eye - glm::normalize(back);
    camera.up = glm::normalize(up);
    camera.vertical_fov_rad = lens.vertical_fov_rad;
    if (lens.orthographic)
        camera.orthographic_half_height_m = lens.half_height_m;
    camera.near_m = lens.near_m;
    return camera;
}

} // namespace estampe
