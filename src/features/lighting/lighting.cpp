// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/terrain.hpp>

#include "core/text.hpp"
#include "gpu/resources.hpp"
#include "style/names.hpp"
#include "style/toml.hpp"
#include "techniques/light/light.glsl.h"

namespace estampe::features {

ViewAnalysis DefaultLight::analysis(const Scene& scene, const light::LightStyle& style,
                                    const std::optional<glm::dvec3>& eye)
{
    const bool has_lights =
        std::ranges::any_of(scene.nodes, [](const Node& node) { return node.light != no_index; });
    if (style.source == light::LightSource::scene ||
        (style.source == light::LightSource::automatic && has_lights)) {
        return {};
    }
    if (!analysis_) {
        cloud_ = surface_cloud(scene, pose_scene(scene, 0.0, no_index));
        analysis_ = analyze_view(*cloud_);
        if (scene.terrain && cloud_->points.empty()) { // the terrain has no triangles yet
            analysis_->wind_towards_deg = scene.terrain->description().wind.towards_deg;
        }
    }
    ViewAnalysis analysis = *analysis_;
    if (!analysis.shelter && eye) {
        analysis.shelter = shelter_around(*cloud_, *eye);
    }
    return analysis;
}

namespace {

constexpr const char* lights_key = "light.lights";
constexpr const char* objects_key = "light.objects";
constexpr int group_count = 16;

[[noreturn]] void fail_word(const std::string& word, const char* key, const char* allowed)
{
    throw Error(fmt::format("{} says nothing of it", style::in_quotes(word)), key,
                fmt::format("allowed: {}", allowed));
}

/// The part of `word` after `name` and a colon.
std::optional<std::string> argument(const std::string& word, const std::string& name)
{
    if (word.size() <= name.size() || word.compare(0, name.size(), name) != 0 || word[name.size()] != ':') {
        return std::nullopt;
    }
    return word.substr(name.size() + 1);
}

/// Reads "1+3" as bits 0 and 2.
Groups parse_groups(const std::string& text, const char* key)
{
    uint32_t bits = 0;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, '+');) {
        const int group = number_from<int>(part).value_or(0);
        if (group < 1 || group > group_count) {
            throw Error(fmt::format("{} is not a group", style::in_quotes(part)), key,
                        fmt::format("groups are 1 to {}, joined as in 1+3", group_count));
        }
        bits |= 1U << static_cast<uint32_t>(group - 1);
    }
    return static_cast<Groups>(bits);
}

float parse_number(const std::string& text, const char* key)
{
    const float number = number_from<float>(text).value_or(-1.0F);
    if (!std::isfinite(number) || number < 0.0F) {
        throw Error(fmt::format("{} is not a number that can be used here", style::in_quotes(text)), key,
                    "it is 0 or more");
    }
    return number;
}

void apply_to_light(Light& light, const std::string& word)
{
    if (word == "off") {
        light.intensity = 0.0F;
    } else if (word == "shadow") {
        light.casters = light.casters != 0 ? light.casters : all_groups;
    } else if (word == "no_shadow") {
        light.casters = 0;
    } else if (word == "inverse_square") {
        light.falloff = LightFalloff::inverse_square;
    } else if (word == "unit_volume") {
        light.falloff = LightFalloff::unit_volume;
    } else if (word == "cone") {
        light.shape = SpotShape::cone;
    } else if (word == "pyramid") {
        light.shape = SpotShape::pyramid;
    } else if (const auto groups = argument(word, "groups")) {
        light.groups = parse_groups(*groups, lights_key);
    } else if (const auto casters = argument(word, "casters")) {
        light.casters = parse_groups(*casters, lights_key);
    } else if (const auto factor = argument(word, "intensity")) {
        light.intensity *= parse_number(*factor, lights_key);
    } else if (const auto range_m = argument(word, "range")) {
        light.range_m = parse_number(*range_m, lights_key);
    } else if (const auto radius_m = argument(word, "radius")) {
        light.radius_m = parse_number(*radius_m, lights_key);
    } else {
        fail_word(word, lights_key,
                  "off, shadow, no_shadow, inverse_square, unit_volume, cone, pyramid, groups:1+2, "
                  "casters:1+2, intensity:2, range:5, radius:0.1");
    }
}

void apply_to_object(LightLinks& links, const std::string& word)
{
    if (word == "cast") {
        links.casts_for = all_groups;
    } else if (word == "no_cast") {
        links.casts_for = 0;
    } else if (word == "receive") {
        links.receives_shadows = true;
    } else if (word == "no_receive") {
        links.receives_shadows = false;
    } else if (const auto groups = argument(word, "groups")) {
        links.lit_by = parse_groups(*groups, objects_key);
    } else if (const auto casts = argument(word, "casts")) {
        links.casts_for = parse_groups(*casts, objects_key);
    } else {
        fail_word(word, objects_key, "cast, no_cast, receive, no_receive, groups:1+2, casts:1+2");
    }
}

template <class Item, class Apply>
void apply_words(Item& item, const std::string& words, Apply apply)
{
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
        apply(item, word);
    }
}

void apply_lights(LightingOfScene& lighting, const Scene& scene, const std::string& text)
{
    for (const style::Assignment& part :
         style::assignments(text, lights_key, "light=words", "Lamp=unit_volume no_shadow, Sun=off")) {
        std::vector<std::string> names;
        std::vector<bool> meant(lighting.lights.size(), false);
        for (Index i = 0; i < lighting.lights.size(); ++i) {
            names.push_back(lighting.lights[i].name);
            meant[i] = names.back() == part.name;
        }
        for (const Node& node : scene.nodes) {
            if (node.light != no_index) {
                names.push_back(node.name);
                meant[node.light] = meant[node.light] || node.name == part.name;
            }
        }
        bool is_known = false;
        for (Index i = 0; i < meant.size(); ++i) {
            if (meant[i]) {
                is_known = true;
                apply_words(lighting.lights[i], part.value, apply_to_light);
            }
        }
        if (!is_known) {
            style::fail_unknown("the scene has no light", part.name, lights_key, names);
        }
    }
}

void apply_below(LightingOfScene& lighting, const Scene& scene, Index top, const std::string& words)
{
    std::vector<Index> open{top};
    while (!open.empty()) {
        const Index node = open.back();
        open.pop_back();
        apply_words(lighting.node_links[node], words, apply_to_object);
        open.insert(open.end(), scene.nodes[node].children.begin(), scene.nodes[node].children.end());
    }
}

void apply_objects(LightingOfScene& lighting, const Scene& scene, const std::string& text)
{
    for (const style::Assignment& part :
         style::assignments(text, objects_key, "object=words", "Glass=no_cast, Floor=no_receive")) {
        std::vector<std::string> names;
        bool is_known = false;
        for (Index i = 0; i < scene.nodes.size(); ++i) {
            names.push_back(scene.nodes[i].name);
            if (names.back() == part.name) {
                is_known = true;
                apply_below(lighting, scene, i, part.value);
            }
        }
        for (Index i = 0; i < scene.materials.size(); ++i) {
            names.push_back(scene.materials[i].name);
            if (names.back() == part.name) {
                is_known = true;
                apply_words(lighting.material_links[i], part.value, apply_to_object);
            }
        }
        if (!is_known) {
            style::fail_unknown("the scene has no node or material", part.name, objects_key, names);
        }
    }
}

} // namespace

LightingOfScene lighting_of(const Scene& scene)
{
    LightingOfScene lighting{.lights = scene.lights};
    for (const Node& node : scene.nodes) {
        lighting.node_links.push_back(node.links);
    }
    for (const Material& material : scene.materials) {
        lighting.material_links.push_back(material.links);
    }
    return lighting;
}

bool same_links(const LightingOfScene& a, const LightingOfScene& b)
{
    return a.node_links == b.node_links && a.material_links == b.material_links;
}

bool same_but_for_brightness(const LightingOfScene& a, const LightingOfScene& b)
{
    const auto alike = [](const Light& one, Light other) {
        const bool both_burn = one.intensity > 0.0F && other.intensity > 0.0F;
        other.intensity = both_burn ? one.intensity : other.intensity;
        return one == other;
    };
    return same_links(a, b) && std::ranges::equal(a.lights, b.lights, alike);
}

void brighten(LightingOfScene& lighting, std::span<const LightBrightness> lights)
{
    for (const LightBrightness& light : lights) {
        if (light.light >= lighting.lights.size()) {
            throw Error(fmt::format("there is no light {}", light.light), "set_brightness",
                        fmt::format("the scene has {}", lighting.lights.size()));
        }
        if (!std::isfinite(light.intensity) || light.intensity < 0.0F) {
            throw Error(fmt::format("{} is no brightness", light.intensity), "set_brightness",
                        "it is 0 or more");
        }
    }
    for (const LightBrightness& light : lights) {
        lighting.lights[light.light].intensity = light.intensity;
    }
}

LightingOfScene styled_lighting(const LightingOfScene& own, const Scene& scene,
                                const light::LightStyle& style)
{
    LightingOfScene lighting = own;
    apply_lights(lighting, scene, style.lights);
    apply_objects(lighting, scene, style.objects);
    return lighting;
}

void set_lighting(Scene& scene, const LightingOfScene& lighting)
{
    scene.lights = lighting.lights;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        scene.nodes[i].links = lighting.node_links[i];
    }
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        scene.materials[i].links = lighting.material_links[i];
    }
}

Scene lit_by_style(Scene scene, const light::LightStyle& style)
{
    set_lighting(scene, styled_lighting(lighting_of(scene), scene, style));
    return scene;
}

void Lighting::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::film_recalled) {
        exposure_.forget();
    }
}

void Lighting::save(FilmWriter& writer)
{
    if (exposure_.time_s()) {
        writer.value(*exposure_.time_s());
        writer.buffers(std::array{&exposure_.buffer()});
    }
}

void Lighting::load(FilmReader& reader)
{
    const auto time_s = reader.value<double>();
    exposure_.recall(reader.buffer("exposure", sizeof(shared::ExposureState)), time_s);
}

void Lighting::upload(gpu::Device& device, const shared::LightGlobals& globals,
                      std::span<const shared::LightRecord> lights)
{
    gpu::upload_items(device, "lighting", std::span(&globals, 1), globals_);
    gpu::upload_items(device, "lights", lights, lights_);
}

} // namespace estampe::features
