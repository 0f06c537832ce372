// SPDX-License-Identifier: MIT
#include "features/lighting/lighting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

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
        // The scene's surfaces have no points yet, because the terrain has no triangles before the first
        // picture.
        if (scene.terrain && cloud_->points.empty()) {
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

constexpr int group_count = 16;

/// Parses light groups: "1+3" becomes bits 0 and 2.
Groups parse_groups(const std::string& text, const char* key)
{
    uint32_t bits = 0;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find('+', begin), text.size());
        const std::string part(trimmed(std::string_view(text).substr(begin, end - begin)));
        const int group = number_from<int>(part).value_or(0);
        if (group < 1 || group > group_count) {
            throw Error(fmt::format("{} is not a group", style::in_quotes(part)), key,
                        fmt::format("groups are numbers from 1 to {}, joined as in 1+3", group_count));
        }
        bits |= 1U << static_cast<uint32_t>(group - 1);
        begin = end + 1;
    }
    return static_cast<Groups>(bits);
}

/// Values of the section `light` of the style that apply to one light, node or material.
struct Changes {
    light::LightStyle style;
    std::optional<bool> shadows;          ///< Set if an override sets `light.shadows`
    std::optional<bool> receives_shadows; ///< Set if an override sets `light.receives_shadows`

    void add(const style::Override& change)
    {
        static const style::Schema<light::LightStyle> schema(light::light_table());
        schema.apply(style, change);
        shadows = change.key == "shadows" ? std::optional(style.shadows) : shadows;
        if (change.key == "receives_shadows") {
            receives_shadows = style.changes.receives_shadows;
        }
    }
};

/// Returns the light groups for which shadows are cast: the groups of the style, or else the groups in the
/// scene's file; none if shadows are turned off. `shadows = true` casts shadows for all groups if the file
/// casts none.
Groups shadow_groups(Groups of_file, const Changes& changes)
{
    const std::string& groups = changes.style.changes.shadow_groups;
    Groups result = groups.empty() ? of_file : parse_groups(groups, "light.shadow_groups");
    if (changes.shadows) {
        result = !*changes.shadows ? Groups{0} : result == 0 ? all_groups : result;
    }
    return result;
}

void apply(Light& light, const Changes& all)
{
    const light::LightChanges& changes = all.style.changes;
    light.intensity = changes.enabled ? changes.intensity * light.intensity : 0.0F;
    light.range_m = changes.range_m >= 0.0F ? changes.range_m : light.range_m;
    light.radius_m = changes.radius_m >= 0.0F ? changes.radius_m : light.radius_m;
    if (changes.attenuation != light::Attenuation::file) {
        light.falloff = changes.attenuation == light::Attenuation::unit_volume ? LightFalloff::unit_volume
                                                                               : LightFalloff::inverse_square;
    }
    if (changes.spot_volume != light::SpotVolume::file) {
        light.shape =
            changes.spot_volume == light::SpotVolume::pyramid ? SpotShape::pyramid : SpotShape::cone;
    }
    light.groups = changes.groups.empty() ? light.groups : parse_groups(changes.groups, "light.groups");
    light.casters = shadow_groups(light.casters, all);
}

void apply(LightLinks& links, const Changes& all)
{
    const light::LightChanges& changes = all.style.changes;
    links.lit_by = changes.groups.empty() ? links.lit_by : parse_groups(changes.groups, "light.groups");
    links.casts_for = shadow_groups(links.casts_for, all);
    links.receives_shadows =
        all.receives_shadows.value_or(links.receives_shadows && changes.receives_shadows);
}

constexpr const char* light_section = "light";

/// Returns the style's lighting values, changed by those overrides of the section `light` for which `accepts`
/// returns true.
template <typename Accepts>
Changes changes_for(const StyleTables& style, Accepts accepts)
{
    Changes changes{.style = style.light, .shadows = {}, .receives_shadows = {}};
    for (const style::Override& change : style.overrides) {
        if (change.section == light_section && accepts(change.surfaces)) {
            changes.add(change);
        }
    }
    return changes;
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

LightingOfScene styled_lighting(const LightingOfScene& own, const Scene& scene, const StyleTables& style)
{
    LightingOfScene lighting = own;
    for (Index i = 0; i < lighting.lights.size(); ++i) {
        apply(lighting.lights[i], changes_for(style, [&](const style::Surfaces& surfaces) {
                  return surfaces.by == style::Surfaces::By::object &&
                         is_named_light(scene, i, surfaces.pattern);
              }));
    }
    for (Index i = 0; i < lighting.node_links.size(); ++i) {
        apply(lighting.node_links[i], changes_for(style, [&](const style::Surfaces& surfaces) {
                  return surfaces.by == style::Surfaces::By::object && is_named(scene, i, surfaces.pattern);
              }));
    }
    for (Index i = 0; i < lighting.material_links.size(); ++i) {
        const Material& material = scene.materials[i];
        const auto kind = kind_of(material);
        apply(lighting.material_links[i], changes_for(style, [&](const style::Surfaces& surfaces) {
                  return surfaces.by == style::Surfaces::By::material &&
                         style::means(surfaces.pattern, material.name, kind);
              }));
    }
    return lighting;
}

LightingSettings::LightingSettings(const StyleTables& style) : changes_(style.light.changes)
{
    std::ranges::copy_if(style.overrides, std::back_inserter(overrides_),
                         [](const style::Override& change) { return change.section == light_section; });
}

bool LightingSettings::are_of(const StyleTables& style) const
{
    if (changes_ != style.light.changes) {
        return false;
    }
    size_t next = 0;
    for (const style::Override& change : style.overrides) {
        if (change.section == light_section &&
            (next == overrides_.size() || !(overrides_[next++] == change))) {
            return false;
        }
    }
    return next == overrides_.size();
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

Scene lit_by_style(Scene scene, const StyleTables& style)
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
