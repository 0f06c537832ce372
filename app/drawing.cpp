// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file.hpp"
#include "scene/outlook/outlook.hpp"
#include "temple/world.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

Index first_placed_camera(const Scene& scene)
{
    Index first = no_index;
    for (const Node& node : scene.nodes) {
        first = std::min(first, node.camera);
    }
    return first;
}

/// Over ground that nothing stands on.
glm::dvec3 towards_sun(const SunBearing& sun, const Terrain& terrain)
{
    SunPlace place{sun.azimuth_deg, sun.elevation_deg};
    if (sun.turns) {
        place = sun_over_ground(place, terrain.description().wind.direction_deg);
    }
    const double azimuth_rad = glm::radians(place.azimuth_deg);
    const double elevation_rad = glm::radians(place.elevation_deg);
    const double level = std::cos(elevation_rad);
    return {level * std::sin(azimuth_rad), std::sin(elevation_rad), level * std::cos(azimuth_rad)};
}

/// Moves everything up by so much, under a node of its own.
void lift(Scene& scene, double height_m)
{
    const auto lifted = static_cast<Index>(scene.nodes.size());
    Node node{.name = "on the ground", .children = scene.roots};
    node.transform.translation.y = height_m;
    scene.nodes.push_back(node);
    for (const Index root : scene.roots) {
        scene.nodes[root].parent = lifted;
    }
    scene.roots = {lifted};
}

/// Worlds and terrains come from no file that could have material variants.
void refuse_variant(const DrawOptions& draw)
{
    if (!draw.load.variant.empty()) {
        throw Error(
            fmt::format("no variant {}: the scene has no material variants", in_quotes(draw.load.variant)),
            draw.scene, "leave --variant out");
    }
}

} // namespace

Scene load_scene_of(const DrawOptions& draw)
{
    if (is_temple(draw.scene)) {
        refuse_variant(draw);
        return temple::World(draw.seed).scene();
    }
    if (lower_extension(draw.scene) == ".toml") {
        refuse_variant(draw);
        Scene scene{.name = draw.scene, .materials = {Material{}}};
        scene.terrain = Terrain(load_terrain(draw.scene));
        return scene;
    }
    Scene scene = load_scene(draw.scene, draw.load);
    if (!draw.terrain.empty()) {
        scene.terrain = Terrain(load_terrain(draw.terrain));
        lift(scene, scene.terrain->sample(0.0, 0.0, draw.time_s).height_m);
    }
    return scene;
}

bool is_temple(const std::string& scene)
{
    return scene == "temple" && !std::filesystem::is_regular_file(scene);
}

bool has_camera_of_file(const DrawOptions& draw, const Scene& scene)
{
    return draw.camera.kind == CameraChoice::Kind::named ||
           (draw.camera.kind == CameraChoice::Kind::automatic && first_placed_camera(scene) != no_index);
}

Camera choose_camera(const DrawOptions& draw, const Scene& scene, Index animation)
{
    if (draw.camera.kind == CameraChoice::Kind::placed) {
        return draw.camera.placed;
    }
    const ScenePose pose = pose_scene(scene, draw.time_s, animation);
    if (draw.camera.kind == CameraChoice::Kind::named) {
        return scene_camera(scene, pose, draw.camera.name);
    }
    if (has_camera_of_file(draw, scene)) {
        return scene_camera(scene, pose, std::to_string(first_placed_camera(scene)));
    }
    if (scene.terrain && scene.meshes.empty()) {
        return terrain_camera(*scene.terrain, draw.time_s,
                              towards_sun(draw.style.sun_bearing(), *scene.terrain));
    }
    return framing_camera(scene, pose, draw.style.window_aspect(draw.page.width, draw.page.height),
                          draw.style.sun_bearing());
}

Index choose_animation(const DrawOptions& draw, const Scene& scene)
{
    if (draw.animation.empty()) {
        return 0;
    }
    std::vector<std::string> names;
    for (const Animation& animation : scene.animations) {
        if (animation.name == draw.animation) {
            return static_cast<Index>(names.size());
        }
        names.push_back(in_quotes(animation.name));
    }
    Index index = 0;
    const char* const end = draw.animation.data() + draw.animation.size();
    const auto [stop, problem] = std::from_chars(draw.animation.data(), end, index);
    if (problem == std::errc{} && stop == end && index < names.size()) {
        return index;
    }
    throw Error(fmt::format("no animation {}", in_quotes(draw.animation)), draw.scene,
                names.empty() ? "the file has none" : fmt::format("it has {}", fmt::join(names, ", ")));
}

RenderSettings settings_of(const DrawOptions& draw, Index animation)
{
    return {.width = draw.page.width,
            .height = draw.page.height,
            .samples = draw.samples,
            .time_s = draw.time_s,
            .animation = animation,
            .tile_px = draw.tile_px};
}

void set_scene(Renderer& renderer, const Scene& scene, const DrawOptions& draw)
{
    // What is asked for on the command line takes the place of what the file names.
    const std::optional<Lightmap> lightmap =
        draw.lightmap.empty() ? named_lightmap(draw.scene) : load_lightmap(draw.lightmap);
    try {
        renderer.set_scene(scene, lightmap ? &*lightmap : nullptr);
    } catch (const Error& problem) {
        if (problem.where().empty()) {
            throw Error(problem.what(), draw.scene);
        }
        throw;
    }
}

} // namespace estampe::app
