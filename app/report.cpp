// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <estampe/default_light.hpp>

#include "core/text.hpp"
#include "scene/visibility.hpp"
#include "scene_details.hpp"

namespace estampe::app {
namespace {

struct PrimitiveCounts {
    uint64_t primitives = 0;
    uint64_t triangles = 0;
    uint64_t lines = 0;
    uint64_t points = 0;
    uint64_t vertices = 0;
    uint64_t morph_targets = 0;

    void add(const Primitive& primitive)
    {
        ++primitives;
        vertices += primitive.positions.size();
        morph_targets += primitive.morph_targets.size();
        switch (primitive.topology) {
        case Topology::triangles:
            triangles += primitive.indices.size() / 3;
            break;
        case Topology::lines:
            lines += primitive.indices.size() / 2;
            break;
        case Topology::points:
            points += primitive.indices.size();
            break;
        }
    }
};

/// Returns the number of drawn triangles: a mesh counts once for every node and instance that shows it.
uint64_t drawn_triangles(const Scene& scene)
{
    uint64_t drawn = 0;
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!visible[i] || node.mesh == no_index) {
            continue;
        }
        PrimitiveCounts counts;
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            counts.add(primitive);
        }
        drawn += counts.triangles * std::max<uint64_t>(1, node.instances.size());
    }
    return drawn;
}

/// The numbers that `estampe info` prints about a scene, such as counts and bounds.
struct SceneSummary {
    /// Labels and numbers in display order.
    std::vector<std::pair<std::string, uint64_t>> counts;
    std::vector<std::string> camera_names;
    Bounds bounds; ///< Bounds of the scene in the rest pose
    LightChoice light = LightChoice::own;
};

/// Counts the parts of a scene. Cost: linear in vertices and triangles, because of the bounds and the light.
SceneSummary summarize(const Scene& scene)
{
    PrimitiveCounts counts;
    for (const Mesh& mesh : scene.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            counts.add(primitive);
        }
    }
    SceneSummary summary;
    summary.counts = {{"nodes", scene.nodes.size()},
                      {"meshes", scene.meshes.size()},
                      {"primitives", counts.primitives},
                      {"vertices", counts.vertices},
                      {"triangles", counts.triangles},
                      {"triangles drawn", drawn_triangles(scene)},
                      {"lines", counts.lines},
                      {"points", counts.points},
                      {"morph targets", counts.morph_targets},
                      {"materials", scene.materials.size()},
                      {"textures", scene.textures.size()},
                      {"lights", scene.lights.size()},
                      {"cameras", scene.cameras.size()},
                      {"skins", scene.skins.size()},
                      {"animations", scene.animations.size()}};
    for (const SceneCamera& camera : scene.cameras) {
        summary.camera_names.push_back(camera.name);
    }
    summary.bounds = scene_bounds(scene, pose_scene(scene, 0.0, no_index));
    summary.light = default_light(scene);
    return summary;
}

using Json = nlohmann::ordered_json;

std::string option_text(const worlds::Option& option)
{
    const std::string& otherwise = option.initial.empty() ? option.without : option.initial;
    return fmt::format("{}: {} [{}]", option.syntax(), option.meaning, otherwise);
}

Json option_json(const worlds::Option& option)
{
    Json json{{"key", option.key},
              {"meaning", option.meaning},
              {"initial", option.initial.empty() ? Json() : Json(option.initial)}};
    if (const auto* const words = std::get_if<worlds::Words>(&option.allowed)) {
        json["words"] = *words;
    } else if (const auto* const numbers = std::get_if<worlds::NumberRange>(&option.allowed)) {
        json["least"] = numbers->least;
        json["most"] = numbers->most;
    } else {
        json["least"] = std::get<worlds::WholeRange>(option.allowed).least;
        json["most"] = std::get<worlds::WholeRange>(option.allowed).most;
    }
    return json;
}

/// Returns the labels and texts about a world, in display order.
std::vector<std::pair<std::string, std::string>> world_rows(const worlds::Description& world)
{
    std::vector<std::pair<std::string, std::string>> rows{{"world", world.summary}};
    if (!world.styles.empty()) {
        rows.emplace_back("styles", fmt::format("{}", fmt::join(world.styles, ", ")));
    }
    if (world.film_s) {
        rows.emplace_back("film",
                          fmt::format("{:g} s along a camera path of its own, with --film", *world.film_s));
    }
    for (const worlds::Option& option : world.options) {
        rows.emplace_back("--world", option_text(option));
    }
    return rows;
}

/// Returns the content of world_rows() as JSON for programs.
Json world_json(const worlds::Description& world)
{
    Json json{{"name", world.name},
              {"summary", world.summary},
              {"styles", world.styles},
              {"film_s", world.film_s ? Json(*world.film_s) : Json()},
              {"options", Json::array()}};
    for (const worlds::Option& option : world.options) {
        json["options"].push_back(option_json(option));
    }
    return json;
}

} // namespace

std::string report_worlds(bool json)
{
    if (json) {
        Json list = Json::array();
        for (const worlds::Description& world : worlds::registry().all()) {
            list.push_back(world_json(world));
        }
        return list.dump(2) + "\n";
    }
    std::string text;
    for (const worlds::Description& world : worlds::registry().all()) {
        text += world.name + "\n";
        for (const auto& [label, words] : world_rows(world)) {
            text += fmt::format("  {:<18} {}\n", label, words);
        }
    }
    return text;
}

std::string world_examples()
{
    std::string lines;
    for (const worlds::Description& world : worlds::registry().all()) {
        for (const std::string& example : world.examples) {
            lines += fmt::format("  {}\n", example);
        }
    }
    return lines;
}

namespace {

/// Writes JSON as text. Names from files may contain bytes that are not UTF-8.
std::string to_text(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string with_underscores(std::string text)
{
    std::replace(text.begin(), text.end(), ' ', '_');
    return text;
}

Json vector_json(const glm::dvec3& vector)
{
    return Json::array({vector.x, vector.y, vector.z});
}

/// Names of a light's type, for JSON and for text.
struct LightNames {
    const char* key;
    const char* words;
};

LightNames names_of(LightChoice light)
{
    switch (light) {
    case LightChoice::own:
        return {"scene", "its own"};
    case LightChoice::sun:
        return {"sun", "none of its own: the style's sun"};
    case LightChoice::lamp:
        return {"lamp", "none of its own, and no sun: a lamp"};
    case LightChoice::lamp_and_daylight:
        return {"lamp_and_daylight", "none of its own: a lamp, and daylight from the open side"};
    }
    return {"", ""};
}

Json scene_json(const SceneSummary& summary, const Scene& scene, const std::string& path)
{
    Json json;
    json["file"] = path;
    for (const auto& [name, count] : summary.counts) {
        json[with_underscores(name)] = count;
    }
    json["bounds"] = summary.bounds.empty() ? Json()
                                            : Json{{"min", vector_json(summary.bounds.min)},
                                                   {"max", vector_json(summary.bounds.max)}};
    json["default_light"] = names_of(summary.light).key;
    json["animation_list"] = Json::array();
    for (const Animation& animation : scene.animations) {
        json["animation_list"].push_back({{"name", animation.name}, {"duration_s", animation.duration_s}});
    }
    json["camera_list"] = summary.camera_names;
    json["extensions_used"] = scene.extensions_used;
    json["extensions_ignored"] = scene.extensions_ignored;
    json["warnings"] = scene.warnings;
    json.update(scene_details(scene, path).json);
    return json;
}

/// Writes bounds as text with four significant digits. Far from the origin, more digits are written, because
/// four digits of the position would hide the size of the box.
std::string in_words(const Bounds& bounds)
{
    constexpr int digits_of_side = 4;
    const glm::dvec3 sides = bounds.max - bounds.min;
    const double longest = std::max({sides.x, sides.y, sides.z});
    const auto in_digits = [longest](double place) {
        const bool is_far = longest > 0.0 && std::abs(place) > longest;
        const double more =
            is_far ? std::floor(std::log10(std::abs(place))) - std::floor(std::log10(longest)) : 0.0;
        const int digits = digits_of_side + static_cast<int>(more);
        return fmt::format("{:.{}g}", place, std::min(digits, std::numeric_limits<double>::max_digits10));
    };
    const auto place = [&](const glm::dvec3& corner) {
        return fmt::format("({}, {}, {})", in_digits(corner.x), in_digits(corner.y), in_digits(corner.z));
    };
    return fmt::format("{} to {}", place(bounds.min), place(bounds.max));
}

std::string listed(const std::vector<std::string>& names)
{
    return names.empty() ? "none" : one_line(fmt::format("{}", fmt::join(names, ", ")));
}

std::string scene_text(const SceneSummary& summary, const Scene& scene, const std::string& path,
                       const worlds::Description* world)
{
    std::string text = one_line(path) + "\n";
    if (world != nullptr) {
        for (const auto& [label, words] : world_rows(*world)) {
            text += fmt::format("  {:<18} {}\n", label, words);
        }
    }
    for (const auto& [name, count] : summary.counts) {
        text += fmt::format("  {:<18} {}\n", name, count);
    }
    for (const auto& [label, words] : scene_details(scene, path).rows) {
        text += fmt::format("  {:<18} {}\n", label, words);
    }
    text += fmt::format("  {:<18} {}\n", "light", names_of(summary.light).words);
    text += fmt::format("  {:<18} {}\n", "extensions used", listed(scene.extensions_used));
    text += fmt::format("  {:<18} {}\n", "extensions ignored", listed(scene.extensions_ignored));
    if (summary.bounds.empty()) {
        return text + fmt::format("  {:<18} empty\n", "bounds");
    }
    return text + fmt::format("  {:<18} {} m\n", "bounds", in_words(summary.bounds));
}

std::string timings_json(const TimingReport& report, double passes_ms)
{
    Json json;
    json["device"] = report.device;
    json["raster"] = name_of(report.raster);
    json["output"] = report.output;
    json["width"] = report.settings.width;
    json["height"] = report.settings.height;
    json["samples"] = report.settings.samples;
    json["frames"] = report.frames;
    json["passes"] = Json::array();
    for (const PassTiming& pass : report.passes) {
        json["passes"].push_back({{"name", pass.name}, {"gpu_ms", pass.gpu_ms}});
    }
    json["passes_gpu_ms"] = passes_ms;
    json["gpu_ms"] = report.gpu_ms;
    for (const SolverReport& solver : report.solvers) {
        json["solvers"].push_back({{"fluid", solver.fluid},
                                   {"solver", solver.solver},
                                   {"steps", solver.steps},
                                   {"divergence_left", solver.divergence_left},
                                   {"gpu_ms", solver.gpu_ms}});
    }
    for (const auto& [step, milliseconds] : report.cpu_ms) {
        json["cpu_ms"][with_underscores(step)] = milliseconds;
    }
    return to_text(json);
}

/// Returns a table of pressure solvers, which begins with an empty line; returns an empty text if `solvers`
/// is empty.
std::string solvers_text(const std::vector<SolverReport>& solvers)
{
    std::string text = solvers.empty() ? ""
                                       : fmt::format("\n{:<9} {:<10} {:>6}  {:>15}  {:>10}\n", "pressure",
                                                     "solver", "steps", "divergence left", "GPU ms");
    for (const SolverReport& solver : solvers) {
        text += fmt::format("{:<9} {:<10} {:>6}  {:>15.2e}  {:>10.3f}\n", solver.fluid, solver.solver,
                            solver.steps, solver.divergence_left, solver.gpu_ms);
    }
    return text;
}

std::string timings_text(const TimingReport& report, double passes_ms)
{
    size_t width = std::string_view("median later frame").size();
    for (const PassTiming& pass : report.passes) {
        width = std::max(width, pass.name.size());
    }
    const auto row = [width](const std::string& name, double milliseconds) {
        return fmt::format("{:<{}}  {:>10.3f}\n", name, width, milliseconds);
    };
    std::string text =
        fmt::format("{}, {} raster, {}x{}\n\n{:<{}}  {:>10}\n", report.device, name_of(report.raster),
                    report.settings.width, report.settings.height, "pass", width, "GPU ms");
    for (const PassTiming& pass : report.passes) {
        text += row(pass.name, pass.gpu_ms);
    }
    text += row("all passes", passes_ms) + row("frame", report.gpu_ms) + solvers_text(report.solvers) +
            fmt::format("\n{:<{}}  {:>10}\n", "step", width, "wall ms");
    for (const auto& [step, milliseconds] : report.cpu_ms) {
        text += row(step, milliseconds);
    }
    return text;
}

} // namespace

std::string report_scene(const Scene& scene, const std::string& path, bool json,
                         const worlds::Description* world)
{
    const SceneSummary summary = summarize(scene);
    if (json) {
        Json all = scene_json(summary, scene, path);
        all["world"] = world != nullptr ? world_json(*world) : Json();
        return to_text(all);
    }
    return scene_text(summary, scene, path, world);
}

std::string report_devices(const std::vector<DeviceInfo>& devices, bool json)
{
    Json list = Json::array();
    std::string text;
    for (const DeviceInfo& device : devices) {
        list.push_back({{"index", device.index},
                        {"name", device.name},
                        {"driver", device.driver},
                        {"software", device.software},
                        {"compute_raster", device.compute_raster},
                        {"usable", device.usable},
                        {"why_not", device.why_not}});
        const std::string state =
            device.usable ? (device.software ? "processor" : "GPU") : "lacks " + device.why_not;
        text += fmt::format("{}  {}  ({})  {}, raster: hardware{}\n", device.index, device.name,
                            device.driver, state, device.compute_raster ? " or compute" : " only");
    }
    return json ? to_text(list) : text;
}

std::string report_protections(const std::string& missing)
{
    return missing.empty()
               ? std::string()
               : fmt::format("files are decoded without {}: this kernel cannot keep a faulty decoder "
                             "from changing files\n",
                             missing);
}

std::string report_timings(const TimingReport& report, bool json)
{
    double passes_ms = 0.0;
    for (const PassTiming& pass : report.passes) {
        passes_ms += pass.gpu_ms;
    }
    return json ? timings_json(report, passes_ms) : timings_text(report, passes_ms);
}

} // namespace estampe::app
