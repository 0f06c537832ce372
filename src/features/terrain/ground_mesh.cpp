// SPDX-License-Identifier: MIT
#include "features/terrain/ground_mesh.hpp"

#include <algorithm>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::features {

namespace {

/// Returns the node of the object that the terrain displaces; returns the end of the list of nodes if the
/// terrain displaces no object.
auto raised_node(const Scene& scene)
{
    return std::ranges::find_if(scene.nodes, [&](const Node& candidate) {
        return candidate.name == scene.terrain->description().meshing.object && candidate.mesh != no_index;
    });
}

/// Returns the bounds of a scene that has only a terrain.
Bounds near_origin(const Terrain& terrain)
{
    const double height_m = terrain.sample(0.0, 0.0).height_m;
    Bounds near;
    near.extend({-20.0, height_m - 5.0, -20.0});
    near.extend({20.0, height_m + 5.0, 20.0});
    return near;
}

bool same_triangles(const TerrainMeshing& a, const TerrainMeshing& b)
{
    return a.method == b.method && a.object == b.object && a.cell_m == b.cell_m && a.cells == b.cells &&
           a.reach_m == b.reach_m;
}

} // namespace

Scene with_terrain_node(const Scene& scene)
{
    Scene result = scene;
    result.materials.push_back({.name = "terrain",
                                .base_color = glm::vec4(scene.terrain->description().look.color, 1.0F),
                                .metallic = 0.0F});
    result.meshes.push_back(
        {.name = "terrain",
         .primitives = {Primitive{.material = static_cast<Index>(result.materials.size() - 1)}}});
    result.roots.push_back(static_cast<Index>(result.nodes.size()));
    result.nodes.push_back({.name = "terrain", .mesh = static_cast<Index>(result.meshes.size() - 1)});
    return result;
}

terrain::ObjectTriangles raised_object(const Scene& scene)
{
    const TerrainMeshing& meshing = scene.terrain->description().meshing;
    if (meshing.method != TerrainMesh::object) {
        return {};
    }
    const auto node = raised_node(scene);
    if (node == scene.nodes.end()) {
        throw Error(fmt::format("the scene has no object \"{}\" for the ground to raise", meshing.object),
                    scene.terrain->description().name, "name one by mesh.object, or use the rings");
    }
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    const glm::dmat4& place = pose.world_from_node[static_cast<size_t>(node - scene.nodes.begin())];
    terrain::ObjectTriangles object;
    for (const Primitive& primitive : scene.meshes[node->mesh].primitives) {
        const auto first = static_cast<uint32_t>(object.places.size());
        for (const glm::vec3& position : primitive.positions) {
            object.places.emplace_back(place * glm::dvec4(position, 1.0));
        }
        for (size_t i = 0; primitive.topology == Topology::triangles && i + 2 < primitive.indices.size();
             i += 3) {
            object.triangles.emplace_back(first + primitive.indices[i], first + primitive.indices[i + 1],
                                          first + primitive.indices[i + 2]);
        }
    }
    return object;
}

pose::ForeignMesh ground_mesh(const Scene& scene)
{
    const auto method = terrain::mesh_method(scene.terrain->description().meshing, raised_object(scene));
    terrain::MeshTopology topology = method->topology();
    const std::vector<shared::TerrainLevel> levels = method->place({}, {});
    pose::ForeignMesh mesh{.node = static_cast<Index>(scene.nodes.size() - 1),
                           .material = static_cast<Index>(scene.materials.size() - 1),
                           .places = std::move(topology.places),
                           .triangles = std::move(topology.triangles),
                           .near = near_origin(*scene.terrain)};
    if (scene.terrain->description().meshing.method == TerrainMesh::object) {
        mesh.instead_of = static_cast<Index>(raised_node(scene) - scene.nodes.begin());
    }
    const bool stands_in_grids = mesh.places.empty();
    const double height_m = scene.terrain->sample(0.0, 0.0).height_m;
    mesh.places.reserve(topology.vertices.size());
    for (size_t i = 0; stands_in_grids && i < topology.vertices.size(); ++i) {
        const glm::dvec2 place(terrain::vertex_place(topology.vertices[i], levels));
        mesh.places.emplace_back(place.x, height_m, place.y);
    }
    return mesh;
}

TerrainChange change_of(const pose::MeshData& layout, const Terrain& own, const Terrain& other)
{
    TerrainChange change{.is_cut_otherwise =
                             !same_triangles(own.description().meshing, other.description().meshing),
                         .bounds = layout.bounds};
    const Bounds near = near_origin(own);
    if (layout.bounds.min == near.min && layout.bounds.max == near.max) {
        change.bounds = near_origin(other);
        change.is_cut_otherwise = change.is_cut_otherwise || pose::anchor_beside_foreign(change.bounds) !=
                                                                 pose::anchor_beside_foreign(near);
    }
    return change;
}

} // namespace estampe::features
