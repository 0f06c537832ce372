// SPDX-License-Identifier: MIT
#include "features/common/style_tables.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "style/parameter.hpp"
#include "style/toml.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::features {

const style::Table<PictureStyle>& picture_table()
{
    static const auto table =
        style::Table<PictureStyle>("picture", "Blank ground below the scene")
            .choice("ground", &PictureStyle::ground,
                    {{"auto", Ground::automatic}, {"drawn", Ground::drawn}, {"none", Ground::none}},
                    "Blank ground below the scene: white paper that shows the scene's shadow. drawn: always; "
                    "none: never; auto: if the scene has no camera of its own and is not a room.");
    return table;
}

style::Sheet sheet_of(StyleTables& tables)
{
    style::Sheet sheet;
    sheet.bind(picture_table(), tables.picture);
    sheet.bind(light::light_table(), tables.light);
    sheet.bind(light::sun_table(), tables.sun);
    sheet.bind(shadow::shadow_table(), tables.shadow);
    sheet.bind(lightmap::lightmap_table(), tables.lightmap);
    sheet.bind(occlusion::occlusion_table(), tables.occlusion);
    sheet.bind(subsurface::subsurface_table(), tables.subsurface);
    sheet.bind(light::tone_table(), tables.tone);
    sheet.bind(transparency::transparency_table(), tables.transparency);
    sheet.bind(hatch::hatch_table(), tables.hatch);
    sheet.bind(tam::tam_table(), tables.tam);
    sheet.bind(contour::contour_table(), tables.contour);
    sheet.bind(bleed::bleed_table(), tables.bleed);
    sheet.bind(ink::ink_table(), tables.ink);
    sheet.bind(smoke::smoke_table(), tables.smoke);
    sheet.bind(focus::focus_table(), tables.focus);
    sheet.bind(wash::wash_table(), tables.wash);
    sheet.bind(haze::haze_table(), tables.haze);
    sheet.bind(lens::lens_table(), tables.lens);
    sheet.bind(motion_blur::motion_blur_table(), tables.motion_blur);
    sheet.bind(terrain::drift_table(), tables.drift);
    sheet.bind(cloth::wind_table(), tables.wind);
    sheet.bind(cloth::cloth_table(), tables.cloth);
    sheet.bind(particles::particle_table(), tables.particles);
    sheet.bind(sky::sky_table(), tables.sky);
    sheet.bind(sky::cloud_table(), tables.clouds);
    sheet.bind(paper::paper_table(), tables.paper);
    sheet.bind_overrides(tables.overrides);
    return sheet;
}

namespace {

using By = style::Surfaces::By;

/// Which of the overrides speak of it, by their numbers.
using Matches = std::vector<bool>;

Matches matches_of(const std::vector<style::Override>& overrides, By by, const std::string& name)
{
    Matches matches(overrides.size(), false);
    for (size_t i = 0; i < overrides.size(); ++i) {
        const style::Surfaces& surfaces = overrides[i].surfaces;
        matches[i] = surfaces.by == by && style::matches(surfaces.pattern, name);
    }
    return matches;
}

void add(Matches& matches, const Matches& more)
{
    for (size_t i = 0; i < more.size(); ++i) {
        matches[i] = matches[i] || more[i];
    }
}

/// By node: what hangs on a node is meant with it.
std::vector<Matches> matches_of_nodes(const Scene& scene, const std::vector<style::Override>& overrides)
{
    std::vector<Matches> own;
    own.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        own.push_back(matches_of(overrides, By::object, node.name));
    }
    std::vector<Matches> all = own;
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        for (Index above = scene.nodes[node].parent; above != no_index; above = scene.nodes[above].parent) {
            add(all[node], own[above]);
        }
    }
    return all;
}

StyleTables look_of(const StyleTables& style, const Matches& matches)
{
    StyleTables look = style;
    look.overrides.clear();
    const style::Sheet sheet = sheet_of(look);
    for (size_t i = 0; i < matches.size(); ++i) {
        if (matches[i]) {
            sheet.apply(style.overrides[i]);
        }
    }
    return look;
}

bool is_seen_through(const StyleTables& style, const Material& material)
{
    return material.transmission && material.alpha_mode != AlphaMode::blend &&
           style.subsurface.transmission && !subsurface::is_clear(style.subsurface);
}

/// A look for what the file says is seen through: strokes pale on it as behind a screen, colour tints where
/// colour is painted.
StyleTables seen_through(StyleTables look, const Material& material)
{
    look.subsurface = subsurface::seen_through(look.subsurface, material, look.wash.strength);
    const float left = 1.0F - 0.7F * look.subsurface.behind;
    look.tone.exposure /= left;
    look.tone.ceiling *= left;
    look.tone.floor *= left;
    return look;
}

contour::ContourStyle lines_of(const std::vector<StyleTables>& styles)
{
    contour::ContourStyle lines = styles.front().contour;
    for (const StyleTables& look : styles) {
        lines.drawn |= look.contour.drawn;
        for (const contour::LineKindKeys& keys : contour::line_kind_keys) {
            lines.*keys.width_mm = std::max(lines.*keys.width_mm, look.contour.*keys.width_mm);
            lines.*keys.width_m = std::max(lines.*keys.width_m, look.contour.*keys.width_m);
        }
    }
    return lines;
}

} // namespace

LookPlan plan_looks(const pose::MeshData& meshes, const Scene& scene, const StyleTables& style,
                    std::vector<StyleTables> room)
{
    LookPlan plan{.styles = std::move(room), .look_of_draw = {}, .lines = style.contour};
    plan.styles.assign(1, style);
    const bool has_clear = std::ranges::any_of(
        scene.materials, [](const Material& material) { return material.transmission.has_value(); });
    if (style.overrides.empty() && !has_clear) {
        return plan;
    }
    const std::vector<Matches> of_nodes = matches_of_nodes(scene, style.overrides);
    std::vector<Matches> of_materials;
    for (const Material& material : scene.materials) {
        of_materials.push_back(matches_of(style.overrides, By::material, material.name));
    }
    std::map<Matches, uint32_t> looks{{Matches(style.overrides.size(), false), 0U}};
    std::map<std::pair<uint32_t, Index>, uint32_t> clear_looks; // by look and material
    for (size_t draw = 0; draw < meshes.draws.size(); ++draw) {
        Matches matches(style.overrides.size(), false);
        if (draw < meshes.sources.size()) { // else it is the ground
            add(matches, of_nodes[meshes.sources[draw].node]);
            if (meshes.draws[draw].material < of_materials.size()) {
                add(matches, of_materials[meshes.draws[draw].material]);
            }
        }
        const auto [look, is_new] = looks.try_emplace(matches, static_cast<uint32_t>(plan.styles.size()));
        if (is_new) {
            plan.styles.push_back(look_of(style, matches));
        }
        uint32_t number = look->second;
        const Index material = meshes.draws[draw].material;
        if (material < scene.materials.size() &&
            is_seen_through(plan.styles[number], scene.materials[material])) {
            const auto [clear, is_first] =
                clear_looks.try_emplace({number, material}, static_cast<uint32_t>(plan.styles.size()));
            if (is_first) {
                plan.styles.push_back(seen_through(plan.styles[number], scene.materials[material]));
            }
            number = clear->second;
        }
        plan.look_of_draw.push_back(number);
    }
    if (!plan.has_several()) {
        plan.look_of_draw.clear();
    }
    plan.lines = lines_of(plan.styles);
    return plan;
}

LookPlan looks_of_nodes(const Scene& scene, const StyleTables& style)
{
    LookPlan plan{.styles = {style}, .look_of_draw = {}, .lines = {}};
    std::map<Matches, uint32_t> looks{{Matches(style.overrides.size(), false), 0U}};
    for (const Matches& matches : matches_of_nodes(scene, style.overrides)) {
        const auto [look, is_new] = looks.try_emplace(matches, static_cast<uint32_t>(plan.styles.size()));
        if (is_new) {
            plan.styles.push_back(look_of(style, matches));
        }
        plan.look_of_draw.push_back(look->second);
    }
    return plan;
}

std::vector<std::string> idle_overrides(const Scene& scene, const StyleTables& style)
{
    std::vector<std::string> notes;
    for (const style::Override& change : style.overrides) {
        const style::Surfaces& surfaces = change.surfaces;
        const auto is_meant = [&](const auto& named) { return style::matches(surfaces.pattern, named.name); };
        const bool by_material = surfaces.by == By::material;
        if (by_material ? std::ranges::none_of(scene.materials, is_meant)
                        : std::ranges::none_of(scene.nodes, is_meant)) {
            std::string note =
                fmt::format("the style speaks of {} {}, of which the scene has none",
                            by_material ? "materials" : "objects", style::in_quotes(surfaces.pattern));
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

} // namespace estampe::features
