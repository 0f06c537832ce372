// SPDX-License-Identifier: MIT
#include "scene/drawn_size.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "scene/visibility.hpp"

namespace estampe {
namespace {

constexpr uint64_t most_vertices = uint64_t{1} << 31U;
constexpr const char* lighten_it = "use a lighter scene, or show fewer copies";

// Lists of places, draws and shadows; of corners and edges: on the processor and on the device.
constexpr uint64_t bytes_a_vertex = 96;
constexpr uint64_t bytes_a_triangle = 96;

DrawnSize size_of(const Primitive& primitive)
{
    constexpr uint64_t corners_of_line = 10;
    constexpr uint64_t triangles_of_line = 10;
    constexpr uint64_t corners_of_point = 6;
    constexpr uint64_t triangles_of_point = 8;
    const uint64_t indices = primitive.indices.size();
    switch (primitive.topology) {
    case Topology::triangles:
        return {primitive.positions.size(), indices / 3};
    case Topology::lines:
        return {indices / 2 * corners_of_line, indices / 2 * triangles_of_line};
    case Topology::points:
        return {indices * corners_of_point, indices * triangles_of_point};
    }
    return {};
}

} // namespace

DrawnSize drawn_size(const Scene& scene)
{
    DrawnSize all;
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (!visible[index] || node.mesh >= scene.meshes.size()) {
            continue;
        }
        const uint64_t copies = std::max<uint64_t>(node.instances.size(), 1);
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            const DrawnSize one = size_of(primitive);
            all.vertices += copies * one.vertices;
            all.triangles += copies * one.triangles;
        }
    }
    return all;
}

void check_drawn_size(const Scene& scene, const std::string& where)
{
    const std::string& place = where.empty() ? scene.name : where;
    const DrawnSize size = drawn_size(scene);
    if (size.vertices > most_vertices || size.triangles > most_vertices) {
        throw Error(fmt::format("the scene shows {} vertices and {} triangles in all, more than {} of either",
                                size.vertices, size.triangles, most_vertices),
                    place, lighten_it);
    }
    require_memory(size.vertices * bytes_a_vertex + size.triangles * bytes_a_triangle,
                   fmt::format("drawing {} vertices and {} triangles", size.vertices, size.triangles), place,
                   lighten_it);
}

} // namespace estampe
