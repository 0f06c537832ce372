// SPDX-License-Identifier: MIT
#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "messages.hpp"
#include "piped_scene.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "scene/visibility.hpp"
#include "style/names.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

/// Value of --animation that plays all animations together.
constexpr const char* all_animations = "all";

std::string name_of(const Animation& animation, size_t index)
{
    return animation.name.empty() ? std::to_string(index) : in_quotes(animation.name);
}

} // namespace

bool add_all_animations(Scene& scene)
{
    const bool is_named = std::ranges::any_of(
        scene.animations, [](const Animation& animation) { return animation.name == all_animations; });
    if (scene.animations.size() < 2 || is_named) {
        return true;
    }
    Animation all{.name = all_animations, .start_s = scene.animations.front().start_s};
    std::set<std::pair<Index, AnimatedPath>> animated;
    std::set<Index> contested;
    for (const Animation& animation : scene.animations) {
        std::set<std::pair<Index, AnimatedPath>> own;
        for (const AnimationChannel& channel : animation.channels) {
            const std::pair key(channel.node, channel.path);
            if (animated.contains(key)) {
                contested.insert(channel.node);
                continue;
            }
            own.insert(key);
            all.channels.push_back(channel);
        }
        animated.merge(own);
        all.duration_s = std::max(all.duration_s, animation.duration_s);
        all.start_s = std::min(all.start_s, animation.start_s);
    }
    if (!contested.empty()) {
        scene.warnings.push_back(fmt::format(
            "several animations move the same nodes ({}, such as \"{}\"): there the first of them is played",
            contested.size(), scene.nodes.at(*contested.begin()).name));
    }
    scene.animations.push_back(std::move(all));
    return contested.empty();
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
    if (draw.animation == all_animations && !names.empty()) {
        return 0; // The scene has only this animation
    }
    if (const auto index = number_from<Index>(draw.animation); index && *index < names.size()) {
        return *index;
    }
    throw Error(fmt::format("no animation {}", in_quotes(draw.animation)), draw.scene,
                names.empty() ? "the file has none"
                              : fmt::format("it has {}, or all", fmt::join(names, ", ")));
}

std::string note_of_animations(const DrawOptions& draw, const Scene& scene)
{
    if (!draw.animation.empty() || scene.animations.size() < 2) {
        return {};
    }
    constexpr size_t most_names = 12;
    std::vector<std::string> others;
    for (size_t i = 1; i < std::min(scene.animations.size(), most_names + 1); ++i) {
        others.push_back(name_of(scene.animations[i], i));
    }
    const size_t more = scene.animations.size() - 1 - others.size();
    return fmt::format("plays animation {} of {}; --animation picks another, or all: {}{}",
                       name_of(scene.animations.front(), 0), scene.animations.size(), fmt::join(others, ", "),
                       more > 0 ? fmt::format(" and {} more", more) : std::string());
}

namespace {

Index first_placed_camera(const Scene& scene)
{
    Index first = no_index;
    for (const Node& node : scene.nodes) {
        first = std::min(first, node.camera);
    }
    return first;
}

/// Direction towards the sun for a scene that is only a terrain, without objects.
glm::dvec3 towards_sun(const SunBearing& sun, const Terrain& terrain)
{
    SunPlace place{sun.azimuth_deg, sun.elevation_deg};
    if (sun.turns) {
        place = sun_over_ground(place, terrain.description().wind.towards_deg);
    }
    const double azimuth_rad = glm::radians(place.azimuth_deg);
    const double elevation_rad = glm::radians(place.elevation_deg);
    const double level = std::cos(elevation_rad);
    return {level * std::sin(azimuth_rad), std::sin(elevation_rad), level * std::cos(azimuth_rad)};
}

/// Lifts the whole scene by adding a root node above all others.
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

/// Checks that the user chose no material variant for a world or a terrain, because only scene files have
/// variants. Throws Error otherwise.
void refuse_variant(const DrawOptions& draw)
{
    if (!draw.load.variant.empty()) {
        throw Error(
            fmt::format("no variant {}: the scene has no material variants", in_quotes(draw.load.variant)),
            draw.scene, "leave --variant out");
    }
}

/// Checks the name of a scene. Throws Error for a name that is neither a file nor a world, and that does not
/// look like a file name.
void check_is_known(const std::string& scene)
{
    std::error_code problem;
    if (!lower_extension(scene).empty() || scene.find('/') != std::string::npos ||
        std::filesystem::exists(scene, problem)) {
        return;
    }
    const std::string meant = style::nearest(scene, world_names());
    throw Error("is neither a file nor a world", scene,
                meant.empty() ? known_worlds() : fmt::format("did you mean the world {}?", meant));
}

/// Returns the path of the scene's file. Under --confine only standard input is a pipe, and a scene from
/// there has no files beside it.
std::filesystem::path file_of(const DrawOptions& draw)
{
    if (!draw.confine.is_on) {
        return scene_file(draw.scene, draw.input_format);
    }
    constexpr uint64_t most_bytes = uint64_t{4} << 30U;
    return draw.scene == standard_input
               ? scene_file(draw.scene, draw.input_format, most_bytes, BesidePipe::nothing)
               : std::filesystem::path(draw.scene);
}

/// Loads the scene from its file or pipe. Error messages contain the name that the user typed.
Scene load_file_of(const DrawOptions& draw)
{
    if (!is_piped(draw.scene)) {
        check_is_known(draw.scene);
    }
    const std::filesystem::path file = file_of(draw);
    LoadOptions options = draw.load;
    options.scope = draw.confine.of(file);
    const auto typed = [&](const std::string& text) { return with_typed_name(text, draw.scene, file); };
    try {
        Scene scene = load_scene(file, options);
        std::ranges::transform(scene.warnings, scene.warnings.begin(), typed);
        if (file != draw.scene && !scene.missing_files.empty() && !draw.confine.is_on) {
            scene.warnings.push_back(missing_beside_pipe(scene.missing_files, draw.scene));
        }
        return scene;
    } catch (const Error& problem) {
        if (file == draw.scene) {
            throw;
        }
        throw Error(typed(problem.what()));
    }
}

/// Returns the view direction of a camera that the program placed automatically.
ViewDirection direction_of_camera(const Camera& camera)
{
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    return {.azimuth_deg = glm::degrees(std::atan2(back.x, back.z)),
            .elevation_deg = glm::degrees(std::asin(std::clamp(back.y, -1.0, 1.0)))};
}

Terrain terrain_of(const DrawOptions& draw, const std::string& file)
{
    const auto read = [&] { return Terrain(load_terrain(file, draw.confine.of(file))); };
    return draw.is_of_job ? unquoted("terrain", "info", read) : read();
}

} // namespace

Scene load_scene_of(const DrawOptions& draw)
{
    if (const std::unique_ptr<worlds::World> world = make_world(draw)) {
        refuse_variant(draw);
        return world->scene();
    }
    if (lower_extension(draw.scene) == ".toml") {
        refuse_variant(draw);
        Scene scene{.name = draw.scene, .materials = {Material{}}};
        scene.terrain = terrain_of(draw, draw.scene);
        scene.files = {draw.scene};
        return scene;
    }
    Scene scene = load_file_of(draw);
    if (draw.animation == all_animations) {
        add_all_animations(scene);
    }
    if (!draw.terrain.empty()) {
        scene.terrain = terrain_of(draw, draw.terrain);
        lift(scene, scene.terrain->sample(0.0, 0.0, draw.time_s).height_m);
    }
    return scene;
}

std::vector<std::filesystem::path> input_files(const DrawOptions& draw, const Scene& scene)
{
    std::vector<std::filesystem::path> files = scene.files;
    for (const std::string& file : {draw.terrain, draw.lightmap}) {
        if (!file.empty()) {
            files.emplace_back(file);
        }
    }
    const auto add = [&](const std::vector<std::filesystem::path>& more) {
        files.insert(files.end(), more.begin(), more.end());
    };
    if (scene.terrain) {
        add(scene.terrain->files());
    }
    add(draw.style.files());
    return files;
}

ReadScope input_scope(const DrawOptions& draw)
{
    ReadScope scope;
    const auto add = [&](const ReadScope& more) {
        scope.folders.insert(scope.folders.end(), more.folders.begin(), more.folders.end());
    };
    for (const std::string& file : {draw.terrain, draw.lightmap}) {
        if (!file.empty()) {
            add(draw.confine.of(file));
        }
    }
    if (draw.confine.is_on) {
        add(draw.confine.of(file_of(draw)));
        add(draw.style.tables().hatch.scope);
    }
    return scope;
}

bool load_the_same(const DrawOptions& a, const DrawOptions& b)
{
    const auto make_same_world = [&] {
        const worlds::Description* const world = world_of(a.scene);
        return world == nullptr || worlds::Values(world->options, a.world)
                                       .make_same_scene(worlds::Values(world->options, b.world));
    };
    return a.scene == b.scene && a.input_format == b.input_format && a.load == b.load &&
           a.confine == b.confine && a.terrain == b.terrain &&
           (a.animation == all_animations) == (b.animation == all_animations) && make_same_world();
}

bool has_camera_of_file(const DrawOptions& draw, const Scene& scene)
{
    return draw.camera.kind == CameraChoice::Kind::named ||
           (draw.camera.kind == CameraChoice::Kind::automatic && first_placed_camera(scene) != no_index);
}

Camera choose_camera(const DrawOptions& draw, const Scene& scene, Index animation)
{
    const CameraChoice& choice = draw.camera;
    if (choice.kind == CameraChoice::Kind::placed) {
        return choice.parallel ? with_parallel_projection(choice.placed, choice.placed.target)
                               : choice.placed;
    }
    const double aspect = draw.style.window_aspect(draw.page.width, draw.page.height);
    const ScenePose pose = pose_scene(scene, draw.time_s, animation);
    if (choice.kind == CameraChoice::Kind::directed) {
        if (scene.meshes.empty()) {
            throw Error("has no objects to frame from a side", draw.scene,
                        "write --camera \"eye=x,y,z target=x,y,z\"");
        }
        ViewDirection direction = choice.direction;
        direction.parallel = direction.parallel || choice.parallel;
        return view_camera(scene, pose, aspect, direction);
    }
    if (has_camera_of_file(draw, scene)) {
        const bool is_named = choice.kind == CameraChoice::Kind::named;
        const Camera camera =
            scene_camera(scene, pose, is_named ? choice.name : std::to_string(first_placed_camera(scene)));
        return choice.parallel ? with_parallel_projection(camera, scene_bounds(scene, pose).center())
                               : camera;
    }
    if (scene.terrain && scene.meshes.empty()) {
        return terrain_camera(*scene.terrain, draw.time_s,
                              towards_sun(draw.style.sun_bearing(), *scene.terrain));
    }
    const Camera framed = framing_camera(scene, pose, aspect, draw.style.sun_bearing());
    if (!choice.parallel) {
        return framed;
    }
    ViewDirection direction = direction_of_camera(framed);
    direction.parallel = true;
    return view_camera(scene, pose, aspect, direction);
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
    // A lightmap on the command line replaces the lightmaps that the scene's file names.
    std::optional<Lightmap> lightmap;
    if (draw.lightmap.empty()) {
        const std::filesystem::path file = file_of(draw);
        lightmap = named_lightmap(file, draw.confine.of(file));
    } else {
        lightmap = load_lightmap(draw.lightmap, draw.confine.of(draw.lightmap));
    }
    try {
        renderer.set_scene(scene, lightmap ? &*lightmap : nullptr);
    } catch (const Error& problem) {
        if (problem.where().empty()) {
            throw Error(problem.what(), draw.scene);
        }
        throw;
    }
}

namespace {

std::string name_of_camera(const DrawOptions& draw, const Scene& scene)
{
    if (draw.camera.kind == CameraChoice::Kind::named)
        return fmt::format("camera {}", in_quotes(draw.camera.name));
    if (draw.camera.kind == CameraChoice::Kind::placed)
        return "the camera given by --camera";
    Index first = no_index;
    for (const Node& node : scene.nodes)
        first = std::min(first, node.camera);
    const std::string& name = scene.cameras[first].name;
    return fmt::format("camera {} of the file", name.empty() ? std::to_string(first) : in_quotes(name));
}

std::string name_of_node(const Scene& scene, Index node)
{
    const std::string& own = scene.nodes[node].name;
    const std::string& name = own.empty() ? scene.meshes[scene.nodes[node].mesh].name : own;
    return name.empty() ? fmt::format("node {}", node) : in_quotes(name);
}

/// Describes why a view is empty, and how to change it.
std::string problem_with(const InView& view, const Scene& scene)
{
    if (view.content == ViewContent::nothing)
        return "sees nothing of the scene; --camera auto frames all of it";
    const std::string name = name_of_node(scene, view.backs_of);
    if (view.holds_eye)
        return fmt::format("stands inside {}, whose one-sided surface is drawn from outside alone, and sees "
                           "nothing else; move it out, or make the material double-sided",
                           name);
    return fmt::format("sees nothing but backs of one-sided surfaces, such as {}, which are not drawn; look "
                       "from their front, or make the material double-sided",
                       name);
}

} // namespace

void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera)
{
    const Moment moment{camera, draw.time_s};
    warn_of_empty_film(draw, scene, animation, {&moment, 1});
}

void warn_of_empty_film(const DrawOptions& draw, const Scene& scene, Index animation,
                        std::span<const Moment> moments)
{
    if (draw.camera.kind != CameraChoice::Kind::placed && !has_camera_of_file(draw, scene))
        return;
    const double aspect = draw.style.window_aspect(draw.page.width, draw.page.height);
    std::optional<InView> first;
    for (const Moment& moment : moments) {
        const InView view =
            find_in_view(scene, pose_scene(scene, moment.time_s, animation), moment.camera, aspect);
        if (view.content == ViewContent::something)
            return;
        first = first.value_or(view);
    }
    if (first)
        print_warnings(
            {fmt::format("{}: {} {}", draw.scene, name_of_camera(draw, scene), problem_with(*first, scene))});
}

} // namespace estampe::app
