// SPDX-License-Identifier: MIT
#include <algorithm>

#include <estampe/scene.hpp>

namespace estampe {

const Cloth* cloth_of(const Scene& scene, const Node& node, const Primitive& primitive)
{
    if (primitive.topology != Topology::triangles) {
        return nullptr;
    }
    if (node.cloth) {
        return &*node.cloth;
    }
    const bool has_material = primitive.material < scene.materials.size();
    return has_material && scene.materials[primitive.material].cloth
               ? &*scene.materials[primitive.material].cloth
               : nullptr;
}

Primitive cloth_sheet(uint32_t columns, uint32_t rows, const glm::vec3& corner_m, const glm::vec3& along_m,
                      const glm::vec3& down_m)
{
    columns = std::max(columns, 3U);
    rows = std::max(rows, 3U);
    const glm::vec3 across = glm::cross(down_m, along_m);
    const float area_m2 = glm::length(across);
    const glm::vec3 normal = area_m2 > 0.0F ? across / area_m2 : glm::vec3(0.0F, 0.0F, 1.0F);
    Primitive sheet;
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(columns - 1);
            const float v = static_cast<float>(y) / static_cast<float>(rows - 1);
            sheet.positions.push_back(corner_m + u * along_m + v * down_m);
            sheet.normals.push_back(normal);
            sheet.uvs[0].emplace_back(u * glm::length(along_m), v * glm::length(down_m));
            if (x + 1 == columns || y + 1 == rows) {
                continue;
            }
            const uint32_t i = y * columns + x;
            const uint32_t j = i + columns;
            // Diagonals by turns, so that neither way is the stiffer one.
            const auto corners = (x + y) % 2 == 0 ? std::array{i, j, j + 1, i, j + 1, i + 1}
                                                  : std::array{i, j, i + 1, i + 1, j, j + 1};
            sheet.indices.insert(sheet.indices.end(), corners.begin(), corners.end());
        }
    }
    sheet.held.assign(sheet.positions.size(), 0.0F);
    return sheet;
}

} // namespace estampe
