// SPDX-License-Identifier: MIT
#include "features/common/style_tables.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "style/material_kind.hpp"
#include "style/parameter.hpp"
#include "style/toml.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::features {

const style::Table<PictureStyle>& picture_table()
{
    static const auto table =
        style::Table<PictureStyle>("picture", "Blank ground below the scene")
            .auto_toggle(
                "ground", &PictureStyle::ground,
                "Blank ground below the scene: white paper that shows the scene's shadow. true: always; "
                "false: never; auto: only if the scene has no camera of its own and is not a room.");
    return table;
}

void limit_files(StyleTables& style, const ReadScope& scope)
{
    for (ReadScope* const own : {&style.contour.scope, &style.hatch.scope, &style.ink.scope,
                                 &style.particles.scope, &style.wash.scope}) {
        *own = scope;
    }
}

const style::Schema<StyleTables>& style_schema()
{
    static const auto schema = style::Schema<StyleTables>()
                                   .section(drawing_table(), &StyleTables::drawing)
                                   .section(picture_table(), &StyleTables::picture)
                                   .section(cells::culling_table(), &StyleTables::culling)
                                   .section(light::light_table(), &StyleTables::light)
                                   .section(light::sun_table(), &StyleTables::sun)
                                   .section(shadow::shadow_table(), &StyleTables::shadow)
                                   .section(lightmap::lightmap_table(), &StyleTables::lightmap)
                                   .section(occlusion::occlusion_table(), &StyleTables::occlusion)
                                   .section(subsurface::subsurface_table(), &StyleTables::subsurface)
                                   .section(light::tone_table(), &StyleTables::tone)
                                   .section(transparency::transparency_table(), &StyleTables::transparency)
                                   .section(hatch::hatch_table(), &StyleTables::hatch)
                                   .section(tam::tam_table(), &StyleTables::tam)
                                   .section(contour::contour_table(), &StyleTables::contour)
                                   .section(bleed::bleed_table(), &StyleTables::bleed)
                                   .section(pigment::pigment_table(), &StyleTables::pigment)
                                   .section(ink::ink_table(), &StyleTables::ink)
                                   .section(smoke::smoke_table(), &StyleTables::smoke)
                                   .section(focus::focus_table(), &StyleTables::focus_lines)
                                   .section(wash::wash_table(), &StyleTables::wash)
                                   .section(haze::haze_table(), &StyleTables::haze)
                                   .section(lens::lens_table(), &StyleTables::lens)
                                   .section(motion_blur::motion_blur_table(), &StyleTables::motion_blur)
                                   .section(terrain::drift_table(), &StyleTables::drift)
                                   .section(wind::wind_table(), &StyleTables::wind)
                                   .section(cloth::cloth_table(), &StyleTables::cloth)
                                   .section(particles::particle_table(), &StyleTables::particles)
                                   .section(sky::sky_table(), &StyleTables::sky)
                                   .section(sky::cloud_table(), &StyleTables::clouds)
                                   .section(paper::paper_table(), &StyleTables::paper)
                                   .overrides(&StyleTables::overrides);
    return schema;
}

std::optional<std::string_view> kind_of(const Material& material)
{
    return style::kind_of({.name = material.name,
                           .metallic = material.metallic,
                           .roughness = material.roughness,
                           .is_foliage = material.is_foliage});
}

namespace {

wind::WindStyle wind_over(const Terrain* terrain, const wind::WindStyle& style)
{
    wind::WindStyle over = style;
    if (terrain != nullptr && style.from == wind::WindSource::automatic) {
        over.speed_m_per_s = terrain->description().wind.speed_m_per_s;
        over.towards_deg = terrain->description().wind.towards_deg;
        // The distance that the wind has blown is computed from its speed and the time.
        over.blown_m = wind::WindStyle().blown_m;
    }
    return over;
}

} // namespace

const StyleTables& with_shared_sections(const StyleTables& style, const Terrain* terrain, StyleTables& room)
{
    const wind::WindStyle over = wind_over(terrain, style.wind);
    const wind::Wind wind{.speed_m_per_s = over.speed_m_per_s, .towards_deg = over.towards_deg};
    const haze::HazeStyle& haze = style.haze;
    if (wind == wind::Wind() && over == style.wind && haze.tint == 0.0F && haze.hatching == 1.0F) {
        return style;
    }
    if (&room != &style) {
        room = style;
    }
    room.wind = over;
    room.hatch.wind = wind;
    room.clouds.wind = wind;
    room.smoke.wind = wind;
    room.particles.wind = wind;
    room.wash.air = room.haze.tint;
    room.wash.air_color = room.haze.tint_color;
    room.wash.air_distance_m = room.haze.tint_distance_m;
    room.hatch.fade = room.haze.hatching;
    room.hatch.fade_distance_m = room.haze.hatching_distance_m;
    return room;
}

namespace {

using By = style::Surfaces::By;

/// For each override of a style: whether the override applies.
using Matches = std::vector<bool>;

/// Returns which overrides by `by` have a pattern that `is_meant` accepts.
template <class IsMeant>
Matches matches_of(const std::vector<style::Override>& overrides, By by, const IsMeant& is_meant)
{
    Matches matches(overrides.size(), false);
    for (size_t i = 0; i < overrides.size(); ++i) {
        const style::Surfaces& surfaces = overrides[i].surfaces;
        matches[i] = surfaces.by == by && is_meant(surfaces.pattern);
    }
    return matches;
}

void add(Matches& matches, const Matches& more)
{
    for (size_t i = 0; i < more.size(); ++i) {
        matches[i] = matches[i] || more[i];
    }
}

/// Returns for each node which overrides apply to it. An override also applies to the node's descendants.
std::vector<Matches> matches_of_nodes(const Scene& scene, const std::vector<style::Override>& overrides)
{
    std::vector<Matches> own;
    own.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        own.push_back(matches_of(overrides, By::object, [&](const std::string& pattern) {
            return style::matches(pattern, node.name);
        }));
    }
    std::vector<Matches> all = own;
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        for (Index above = scene.nodes[node].parent; above != no_index; above = scene.nodes[above].parent) {
            add(all[node], own[above]);
        }
    }
    return all;
}

StyleTables variant_of(const StyleTables& style, const Matches& matches)
{
    StyleTables variant = style;
    variant.overrides.clear();
    for (size_t i = 0; i < matches.size(); ++i) {
        if (matches[i]) {
            style_schema().apply(variant, style.overrides[i]);
        }
    }
    return variant;
}

bool is_seen_through(const StyleTables& style, const Material& material)
{
    return material.transmission && material.alpha_mode != AlphaMode::blend &&
           style.subsurface.transmission && !subsurface::is_clear(style.subsurface);
}

/// The style variant of a transparent material: strokes on the material are paler. If the style paints
/// colour, the surfaces behind the material are seen in its colour.
StyleTables seen_through(StyleTables variant, const Material& material)
{
    variant.subsurface = subsurface::seen_through(variant.subsurface, material, variant.wash.strength);
    const float left = 1.0F - 0.7F * variant.subsurface.behind;
    variant.tone.exposure /= left;
    variant.tone.ceiling *= left;
    variant.tone.floor *= left;
    return variant;
}

contour::ContourStyle lines_of(const std::vector<StyleTables>& styles)
{
    contour::ContourStyle lines = styles.front().contour;
    for (const StyleTables& variant : styles) {
        lines.enabled |= variant.contour.enabled;
        for (const contour::LineKind& kind : contour::line_kinds) {
            contour::LineStyle& line = lines.*kind.style;
            const contour::LineStyle& other = variant.contour.*kind.style;
            if (other.enabled) {
                line.width_mm = line.enabled ? std::max(line.width_mm, other.width_mm) : other.width_mm;
                line.width_m = line.enabled ? std::max(line.width_m, other.width_m) : other.width_m;
                line.enabled = true;
            }
        }
    }
    return lines;
}

} // namespace

bool StyleVariants::has_inks_by_kind() const
{
    return std::ranges::any_of(
        styles, [](const StyleTables& style) { return contour::has_inks_by_kind(style.contour); });
}

namespace {

/// For each override: whether it changes how surfaces are drawn. Parameters that may differ only by object do
/// not: they belong to lights, ink zones and emitters, which are found by their nodes. Light links of the
/// section `light` do not change it either.
Matches overrides_of_surfaces(const std::vector<style::Override>& overrides)
{
    Matches matches;
    for (const style::Override& change : overrides) {
        const auto found = style_schema().find(change.section + "." + change.key);
        matches.push_back(found.parameter != nullptr && change.section != "light" &&
                          found.parameter->overridable == style::Overridable::by_surface);
    }
    return matches;
}

} // namespace

StyleVariants style_variants(const pose::MeshData& meshes, const Scene& scene, const StyleTables& style,
                             std::vector<StyleTables> room)
{
    StyleVariants plan{.styles = std::move(room), .variant_of_draw = {}, .lines = style.contour};
    plan.styles.assign(1, style);
    const bool has_clear = std::ranges::any_of(
        scene.materials, [](const Material& material) { return material.transmission.has_value(); });
    if (style.overrides.empty() && !has_clear) {
        return plan;
    }
    const Matches of_surfaces = overrides_of_surfaces(style.overrides);
    const std::vector<Matches> of_nodes = matches_of_nodes(scene, style.overrides);
    std::vector<Matches> of_materials;
    for (const Material& material : scene.materials) {
        const auto kind = kind_of(material);
        of_materials.push_back(matches_of(style.overrides, By::material, [&](const std::string& pattern) {
            return style::means(pattern, material.name, kind);
        }));
    }
    std::map<Matches, uint32_t> variants{{Matches(style.overrides.size(), false), 0U}};
    // Index of the style variant for a transparent material. The key is the variant without transparency, and
    // the material.
    std::map<std::pair<uint32_t, Index>, uint32_t> clear_variants;
    for (size_t draw = 0; draw < meshes.draws.size(); ++draw) {
        Matches matches(style.overrides.size(), false);
        if (draw < meshes.sources.size()) { // A draw call without a source object is the ground
            add(matches, of_nodes[meshes.sources[draw].node]);
            if (meshes.draws[draw].material < of_materials.size()) {
                add(matches, of_materials[meshes.draws[draw].material]);
            }
        }
        for (size_t i = 0; i < matches.size(); ++i) {
            matches[i] = matches[i] && of_surfaces[i];
        }
        const auto [variant, is_new] =
            variants.try_emplace(matches, static_cast<uint32_t>(plan.styles.size()));
        if (is_new) {
            plan.styles.push_back(variant_of(style, matches));
        }
        uint32_t number = variant->second;
        const Index material = meshes.draws[draw].material;
        if (material < scene.materials.size() &&
            is_seen_through(plan.styles[number], scene.materials[material])) {
            const auto [clear, is_first] =
                clear_variants.try_emplace({number, material}, static_cast<uint32_t>(plan.styles.size()));
            if (is_first) {
                plan.styles.push_back(seen_through(plan.styles[number], scene.materials[material]));
            }
            number = clear->second;
        }
        plan.variant_of_draw.push_back(number);
    }
    if (!plan.has_several()) {
        plan.variant_of_draw.clear();
    }
    plan.lines = lines_of(plan.styles);
    return plan;
}

StyleVariants style_variants_of_nodes(const Scene& scene, const StyleTables& style)
{
    StyleVariants plan{.styles = {style}, .variant_of_draw = {}, .lines = {}};
    std::map<Matches, uint32_t> variants{{Matches(style.overrides.size(), false), 0U}};
    for (const Matches& matches : matches_of_nodes(scene, style.overrides)) {
        const auto [variant, is_new] =
            variants.try_emplace(matches, static_cast<uint32_t>(plan.styles.size()));
        if (is_new) {
            plan.styles.push_back(variant_of(style, matches));
        }
        plan.variant_of_draw.push_back(variant->second);
    }
    return plan;
}

namespace {

bool has_light(const Scene& scene, const std::string& pattern)
{
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].light != no_index && is_named(scene, node, pattern)) {
            return true;
        }
    }
    return std::ranges::any_of(scene.lights,
                               [&](const Light& light) { return style::matches(pattern, light.name); });
}

/// Describes what the override needs but the scene does not have. Returns an empty text if the scene has it.
std::string missing(const Scene& scene, const style::Override& change)
{
    const std::string& pattern = change.surfaces.pattern;
    const auto is_meant = [&](const auto& named) { return style::matches(pattern, named.name); };
    if (change.surfaces.by == By::material) {
        // A style that draws eight kinds of material is meant for scenes that have some of them.
        const bool is_of_kind = style::named_kind(pattern).has_value();
        return is_of_kind || std::ranges::any_of(scene.materials, is_meant) ? "" : "materials";
    }
    const bool is_of_lights = change.section == "light";
    const auto found = style_schema().find(change.section + "." + change.key);
    if (is_of_lights && found.parameter->overridable == style::Overridable::by_object) {
        return has_light(scene, pattern) ? "" : "lights";
    }
    const bool is_there =
        std::ranges::any_of(scene.nodes, is_meant) || (is_of_lights && has_light(scene, pattern));
    return is_there ? "" : "objects";
}

} // namespace

std::vector<std::string> idle_overrides(const Scene& scene, const StyleTables& style)
{
    std::vector<std::string> notes;
    for (const style::Override& change : style.overrides) {
        if (const std::string things = missing(scene, change); !things.empty()) {
            std::string note = fmt::format("the style speaks of {} {}, of which the scene has none", things,
                                           style::in_quotes(change.surfaces.pattern));
            if (std::ranges::find(notes, note) == notes.end()) {
                notes.push_back(std::move(note));
            }
        }
    }
    return notes;
}

bool is_named(const Scene& scene, Index node, const std::string& pattern)
{
    for (; node != no_index; node = scene.nodes[node].parent) {
        if (style::matches(pattern, scene.nodes[node].name)) {
            return true;
        }
    }
    return false;
}

bool is_named_light(const Scene& scene, Index light, const std::string& pattern)
{
    if (style::matches(pattern, scene.lights[light].name)) {
        return true;
    }
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].light == light && is_named(scene, node, pattern)) {
            return true;
        }
    }
    return false;
}

} // namespace estampe::features
