// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "scene/camera_words.hpp"

namespace estampe {
namespace {

constexpr const char* camera_form =
    "write \"eye=x,y,z target=x,y,z fov=degrees\", such as \"eye=2,1,3 target=0,0.5,0 fov=35\", and if need "
    "be up=x,y,z, ortho or ortho=half_height";

bool parallel(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

std::string list_cameras(const Scene& scene)
{
    constexpr const char* other_forms =
        "write auto, \"eye=2,1,3 target=0,0.5,0 fov=35\" or \"azimuth=30 elevation=20\"; --view takes sides";
    if (scene.cameras.empty())
        return fmt::format("the scene has no cameras: leave --camera out, or {}", other_forms);
    std::string list;
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        list += fmt::format("{}{} \"{}\"", list.empty() ? "" : ", ", i, scene.cameras[i].name);
    return fmt::format("cameras of the scene: {}; or {}", list, other_forms);
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
    const CameraWords words(text, camera_form, {"eye", "target", "fov", "up", "ortho"}, {"ortho"});
    Camera camera;
    for (const char* key : {"eye", "target"})
        if (!words.has(key))
            words.refuse(fmt::format("\"{}\" is missing", key));
    camera.eye = *words.vector("eye");
    camera.target = *words.vector("target");
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(view) <= 1e-9 * (1.0 + glm::length(camera.eye)))
        words.refuse("eye and target are the same point");
    if (const auto up = words.vector("up")) {
        if (glm::length(*up) == 0.0 || parallel(*up, view))
            words.refuse("up must not be zero, nor along the line from eye to target");
        camera.up = glm::normalize(*up);
    } else if (parallel(camera.up, view)) {
        camera.up = {0.0, 0.0, -1.0};
    }
    if (const auto degrees = words.fov_deg())
        camera.vertical_fov_rad = glm::radians(*degrees);
    if (words.has("ortho"))
        camera.orthographic_half_height_m =
            words.half_height_m().value_or(glm::length(view) * std::tan(0.5 * camera.vertical_fov_rad));
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
