// SPDX-License-Identifier: MIT
#include "features/ink/ink_zones.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "features/ink/zone_shape.hpp"
#include "style/names.hpp"
#include "style/parameter.hpp"
#include "techniques/ink/ink_style.hpp"

namespace estampe::features {

std::optional<glm::dvec2> page_place_mm(const shared::FrameGlobals& page, const glm::dvec3& anchor,
                                        const glm::dvec3& point)
{
    const glm::dvec4 clip = glm::dmat4(page.clip_from_anchor) * glm::dvec4(point - anchor, 1.0);
    if (clip.w <= 1e-6) {
        return std::nullopt;
    }
    const glm::dvec2 share = 0.5 * glm::dvec2(clip) / clip.w + 0.5;
    return share * glm::dvec2(page.page_px) / static_cast<double>(page.pixels_per_mm);
}

namespace {

/// The triangles of a node's mesh on the page. Triangles that reach behind the eye are left out.
std::vector<PageTriangle> page_triangles(const ZoneView& view, const Node& node,
                                         const glm::dmat4& world_from_node)
{
    std::vector<PageTriangle> triangles;
    const std::vector<glm::mat4> one{glm::mat4(1.0F)};
    for (const glm::mat4& instance : node.instances.empty() ? one : node.instances) {
        const glm::dmat4 world_from_mesh = world_from_node * glm::dmat4(instance);
        for (const Primitive& primitive : view.scene.meshes[node.mesh].primitives) {
            std::vector<std::optional<glm::dvec2>> places_mm;
            for (const glm::vec3& position : primitive.positions) {
                places_mm.push_back(page_place_mm(view.page, view.anchor,
                                                  glm::dvec3(world_from_mesh * glm::dvec4(position, 1.0))));
            }
            const bool has_triangles = primitive.topology == Topology::triangles;
            for (size_t i = 0; has_triangles && i + 2 < primitive.indices.size(); i += 3) {
                const auto place = [&](size_t corner) { return places_mm[primitive.indices[i + corner]]; };
                if (place(0) && place(1) && place(2)) {
                    triangles.push_back({glm::vec2(*place(0)), glm::vec2(*place(1)), glm::vec2(*place(2))});
                }
            }
        }
    }
    return triangles;
}

/// The disc that a sphere of one metre in the node's space covers on the page.
std::optional<shared::InkZone> disc_zone(const ZoneView& view, const glm::dmat4& world_from_node)
{
    const glm::dvec3 middle(world_from_node[3]);
    const double radius_m =
        std::max({glm::length(glm::dvec3(world_from_node[0])), glm::length(glm::dvec3(world_from_node[1])),
                  glm::length(glm::dvec3(world_from_node[2]))});
    const auto middle_mm = page_place_mm(view.page, view.anchor, middle);
    if (!middle_mm) {
        return std::nullopt;
    }
    double radius_mm = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 beside(0.0);
        beside[axis] = 0.01 * radius_m;
        if (const auto beside_mm = page_place_mm(view.page, view.anchor, middle + beside)) {
            radius_mm = std::max(radius_mm, 100.0 * glm::distance(*middle_mm, *beside_mm));
        }
    }
    constexpr double smallest_mm = 0.1;
    return shared::InkZone{.middle_mm = glm::vec2(*middle_mm),
                           .radius_mm = static_cast<float>(std::max(radius_mm, smallest_mm))};
}

/// Direction on the page in which the -z axis of a node points.
glm::dvec2 ahead_on_page(const ZoneView& view, const glm::dmat4& world_from_node)
{
    const glm::dvec3 middle(world_from_node[3]);
    const glm::dvec3 ahead = -glm::normalize(glm::dvec3(world_from_node[2]));
    const double step_m = 0.01 * glm::length(glm::dvec3(world_from_node[2]));
    const auto from_mm = page_place_mm(view.page, view.anchor, middle);
    const auto to_mm = page_place_mm(view.page, view.anchor, middle + step_m * ahead);
    const glm::dvec2 moved = from_mm && to_mm ? *to_mm - *from_mm : glm::dvec2(0.0);
    return glm::length(moved) > 1e-9 ? glm::normalize(moved) : glm::dvec2(0.0);
}

/// Adds the zone of a node: the area that its mesh covers, or a disc if it has no mesh.
void add_zone(InkZones& zones, const ZoneView& view, size_t node, const ink::ZoneStyle& style)
{
    const Node& from = view.scene.nodes[node];
    const glm::dmat4& world_from_node = view.pose.world_from_node[node];
    std::optional<shared::InkZone> zone;
    if (from.mesh == no_index) {
        zone = disc_zone(view, world_from_node);
    } else if (const auto shape = zone_shape(page_triangles(view, from, world_from_node))) {
        zone = shared::InkZone{.middle_mm = shape->middle_mm,
                               .radius_mm = shape->radius_mm,
                               .shape = static_cast<uint32_t>(zones.shapes.size() / shape->field.size() + 1),
                               .shape_min_mm = shape->min_mm,
                               .shape_size_mm = shape->size_mm};
        std::ranges::copy(shape->field, std::back_inserter(zones.shapes));
    }
    if (zone) {
        zone->amount = style.amount;
        zone->velocity_mm_per_s = style.blow_mm_per_s * glm::vec2(ahead_on_page(view, world_from_node));
        zone->turn_rad_s = glm::radians(style.turn_deg_per_s);
        zone->gives = style.give;
        zones.zones.push_back(*zone);
    }
}

/// Returns whether an override describes an ink zone.
bool is_of_zone(const style::Override& change)
{
    return change.surfaces.by == style::Surfaces::By::object && change.section == "ink" &&
           change.key.starts_with("zone.");
}

} // namespace

std::vector<bool> ink_zone_nodes(const Scene& scene, const StyleTables& style)
{
    if (std::ranges::none_of(style.overrides, is_of_zone)) {
        return {};
    }
    std::vector<bool> are_zones(scene.nodes.size(), false);
    for (const style::Override& change : style.overrides) {
        for (size_t node = 0; is_of_zone(change) && node < scene.nodes.size(); ++node) {
            are_zones[node] =
                are_zones[node] || style::matches(change.surfaces.pattern, scene.nodes[node].name);
        }
    }
    return are_zones;
}

InkZones ink_zones(const ZoneView& view, const StyleTables& style)
{
    static const style::Schema<ink::InkStyle> schema(ink::ink_table());
    InkZones zones;
    std::vector<bool> is_done(view.scene.nodes.size(), false);
    for (const style::Override& first : style.overrides) {
        for (size_t node = 0; is_of_zone(first) && node < view.scene.nodes.size(); ++node) {
            const std::string& name = view.scene.nodes[node].name;
            if (is_done[node] || !style::matches(first.surfaces.pattern, name)) {
                continue;
            }
            is_done[node] = true;
            ink::InkStyle styled = style.ink;
            for (const style::Override& change : style.overrides) {
                if (is_of_zone(change) && style::matches(change.surfaces.pattern, name)) {
                    schema.apply(styled, change);
                }
            }
            if (zones.zones.size() < shared::most_ink_zones) {
                add_zone(zones, view, node, styled.zone);
            }
        }
    }
    return zones;
}

} // namespace estampe::features
