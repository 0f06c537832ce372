// SPDX-License-Identifier: MIT
#include "features/hatching/form_strokes.hpp"

#include <algorithm>
#include <map>

#include "shaders/stroke_kind.glsl.h"
#include "techniques/form/form.hpp"

namespace estampe::features {
namespace {

/// Triangles of one draw, and where they stand among all.
struct DrawTriangles {
    std::vector<uint32_t> indices; ///< into the vertices of the draw
    std::vector<size_t> numbers;
};

} // namespace

std::vector<glm::vec2> form_coordinates(const pose::MeshData& meshes, const StrokePlan& plan)
{
    std::map<uint32_t, DrawTriangles> draws;
    for (size_t i = 0; i < meshes.triangles.size(); ++i) {
        const glm::uvec4& triangle = meshes.triangles[i];
        const uint32_t draw = triangle.w & shared::triangle_draw_mask;
        if (plan.kind_of_draw[draw] == shared::strokes_form) {
            DrawTriangles& own = draws[draw];
            for (int k = 0; k < 3; ++k) {
                own.indices.push_back(triangle[k] - meshes.draws[draw].first_posed_vertex);
            }
            own.numbers.push_back(i);
        }
    }
    std::vector<glm::vec2> coordinates(3 * meshes.triangles.size());
    const auto unit_m = static_cast<float>(meshes.stroke_unit_m);
    for (const auto& [index, own] : draws) {
        const shared::DrawRecord& draw = meshes.draws[index];
        std::vector<glm::vec3> positions_m;
        for (uint32_t i = 0; i < draw.vertex_count; ++i) {
            positions_m.push_back(meshes.stroke_coordinates[draw.first_posed_vertex + i] * unit_m);
        }
        const form::FormField field =
            form::follow_form(positions_m, own.indices, {.period_m = 0.25F * unit_m});
        for (size_t i = 0; i < own.numbers.size(); ++i) {
            std::copy(field.corners[i].begin(), field.corners[i].end(),
                      coordinates.begin() + static_cast<std::ptrdiff_t>(3 * own.numbers[i]));
        }
    }
    return coordinates;
}

} // namespace estampe::features
