// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "techniques/cells/cells.hpp"

namespace estampe::cells {
namespace {

bool is_named(const Node& node, const char* beginning)
{
    return node.visible && node.mesh == no_index && node.light == no_index && node.camera == no_index &&
           node.name.starts_with(beginning);
}

Index cell_around(std::span<const SceneCell> cells, const glm::dvec3& place)
{
    const auto found = std::ranges::find_if(cells, [&](const SceneCell& cell) {
        return glm::all(glm::greaterThanEqual(place, cell.low_m)) &&
               glm::all(glm::lessThanEqual(place, cell.high_m));
    });
    return found == cells.end() ? no_index : static_cast<Index>(found - cells.begin());
}

/// Returns the rectangle that halves a node's cube across its shortest side.
ScenePortal portal_in(std::span<const SceneCell> cells, const glm::dmat4& world_from_node)
{
    const glm::dvec3 middle(world_from_node[3]);
    int thin = 0;
    for (int axis = 1; axis < 3; ++axis) {
        const double length = glm::length(glm::dvec3(world_from_node[axis]));
        thin = length < glm::length(glm::dvec3(world_from_node[thin])) ? axis : thin;
    }
    const glm::dvec3 across(world_from_node[(thin + 1) % 3]);
    const glm::dvec3 along(world_from_node[(thin + 2) % 3]);
    // Beside the cube the cells must differ. A cube without thickness is given some.
    constexpr double beside_m = 0.01;
    const glm::dvec3 area = glm::cross(across, along);
    const double size = glm::length(area);
    const glm::dvec3 normal = size > 0.0 ? area / size : glm::dvec3(0.0);
    const glm::dvec3 off = (glm::length(glm::dvec3(world_from_node[thin])) + beside_m) * normal;
    return {.corners_m = {middle - across - along, middle + across - along, middle + across + along,
                          middle - across + along},
            .from = cell_around(cells, middle - off),
            .to = cell_around(cells, middle + off)};
}

} // namespace

NamedCells named_cells(const Scene& scene)
{
    NamedCells named;
    if (std::ranges::none_of(scene.nodes, [](const Node& node) { return is_named(node, "cell"); })) {
        return named;
    }
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    for (Index i = 0; i < scene.nodes.size(); ++i) {
        if (!is_named(scene.nodes[i], "cell")) {
            continue;
        }
        const glm::dmat4& place = pose.world_from_node[i];
        const glm::dvec3 half =
            glm::abs(glm::dvec3(place[0])) + glm::abs(glm::dvec3(place[1])) + glm::abs(glm::dvec3(place[2]));
        if (!glm::all(glm::greaterThan(half, glm::dvec3(0.0)))) {
            named.notes.push_back(fmt::format("{} has no volume and is no cell", scene.nodes[i].name));
            continue;
        }
        named.cells.push_back({.name = scene.nodes[i].name,
                               .low_m = glm::dvec3(place[3]) - half,
                               .high_m = glm::dvec3(place[3]) + half});
    }
    for (Index i = 0; i < scene.nodes.size(); ++i) {
        if (!is_named(scene.nodes[i], "portal")) {
            continue;
        }
        ScenePortal portal = portal_in(named.cells, pose.world_from_node[i]);
        if (portal.from == portal.to) {
            named.notes.push_back(
                fmt::format("{} has no area or joins no two cells, and is no portal", scene.nodes[i].name));
            continue;
        }
        named.portals.push_back(std::move(portal));
    }
    return named;
}

} // namespace estampe::cells
