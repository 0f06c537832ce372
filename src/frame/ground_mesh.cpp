// SPDX-License-Identifier: MIT
#include "frame/ground_mesh.hpp"

#include "techniques/terrain/mesh/mesh_method.hpp"

namespace estampe::frame {

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

pose::ForeignMesh ground_mesh(const Scene& scene)
{
    const auto method = terrain::mesh_method(scene.terrain->description().meshing);
    terrain::MeshTopology topology = method->topology();
    const std::vector<shared::TerrainLevel> levels = method->place({}, {});
    pose::ForeignMesh mesh{.node = static_cast<Index>(scene.nodes.size() - 1),
                           .material = static_cast<Index>(scene.materials.size() - 1),
                           .triangles = std::move(topology.triangles)};
    const double height_m = scene.terrain->sample(0.0, 0.0).height_m;
    mesh.places.reserve(topology.vertices.size());
    for (const uint32_t vertex : topology.vertices) {
        const glm::dvec2 place(terrain::vertex_place(vertex, levels));
        mesh.places.emplace_back(place.x, height_m, place.y);
    }
    mesh.near.extend({-20.0, height_m - 5.0, -20.0});
    mesh.near.extend({20.0, height_m + 5.0, 20.0});
    return mesh;
}

} // namespace estampe::frame
