// SPDX-License-Identifier: MIT
#include "techniques/terrain/mesh/mesh_methods.hpp"

#include <cmath>
#include <limits>

namespace estampe::terrain {

Grid::Grid(const TerrainMeshing& meshing) : cell_m_(cell_of(meshing)), cells_(cells_of(meshing, 16)) {}

MeshTopology Grid::topology() const
{
    MeshTopology mesh;
    const uint32_t row = cells_ + 1;
    for (uint32_t j = 0; j <= cells_; ++j) {
        for (uint32_t i = 0; i <= cells_; ++i) {
            mesh.vertices.push_back(i | j << shared::terrain_index_bits);
        }
    }
    for (uint32_t j = 0; j < cells_; ++j) {
        for (uint32_t i = 0; i < cells_; ++i) {
            const uint32_t corner = j * row + i;
            mesh.triangles.emplace_back(corner, corner + row + 1, corner + 1);
            mesh.triangles.emplace_back(corner, corner + row, corner + row + 1);
        }
    }
    return mesh;
}

std::vector<shared::TerrainLevel> Grid::place(const EyePlace& eye, const glm::dvec2& anchor_m) const
{
    const bool along_x = std::abs(eye.ahead.x) >= std::abs(eye.ahead.y);
    const double side = (along_x ? eye.ahead.x : eye.ahead.y) < 0.0 ? -1.0 : 1.0;
    const glm::dvec2 quarter = 0.25 * cells_ * side * (along_x ? glm::dvec2(1.0, 0.0) : glm::dvec2(0.0, 1.0));
    const glm::dvec2 origin = glm::floor(eye.eye_m / cell_m_) - 0.5 * cells_ + quarter;
    constexpr float never = std::numeric_limits<float>::max();
    return {{.origin_m = glm::vec2(origin * cell_m_ - anchor_m),
             .eye_cells = glm::vec2(eye.eye_m / cell_m_ - origin),
             .cell_m = static_cast<float>(cell_m_),
             .fade_from = never,
             .fade_to = never}};
}

} // namespace estampe::terrain
