// SPDX-License-Identifier: MIT
#include "techniques/terrain/mesh/mesh_method.hpp"

#include <cmath>

#include "techniques/terrain/mesh/mesh_methods.hpp"

namespace estampe::terrain {

std::unique_ptr<MeshMethod> mesh_method(const TerrainMeshing& meshing, const ObjectTriangles& object)
{
    if (meshing.method == TerrainMesh::object) {
        return std::make_unique<Raised>(object);
    }
    if (meshing.method == TerrainMesh::grid) {
        return std::make_unique<Grid>(meshing);
    }
    return std::make_unique<Rings>(meshing);
}

double cell_of(const TerrainMeshing& meshing)
{
    return std::exp2(std::round(std::log2(static_cast<double>(meshing.cell_m))));
}

uint32_t cells_of(const TerrainMeshing& meshing, uint32_t least)
{
    return std::max(least, (static_cast<uint32_t>(meshing.cells) + 3U) / 4U * 4U);
}

glm::vec2 vertex_place(uint32_t vertex, const std::vector<shared::TerrainLevel>& levels)
{
    constexpr uint32_t mask = (1U << shared::terrain_index_bits) - 1U;
    const shared::TerrainLevel& level = levels[vertex >> 28U];
    glm::uvec2 index(vertex & mask, vertex >> shared::terrain_index_bits & mask);
    const uint32_t part = vertex >> 26U & 3U;
    if (part == shared::terrain_part_trim_column) {
        index += level.hole_first + glm::uvec2(level.hole_shift.x == 1 ? 0 : level.hole_count, 0);
    } else if (part == shared::terrain_part_trim_row) {
        index +=
            level.hole_first + glm::uvec2(level.hole_shift.x, level.hole_shift.y == 1 ? 0 : level.hole_count);
    }
    return level.origin_m + level.cell_m * glm::vec2(index);
}

} // namespace estampe::terrain
