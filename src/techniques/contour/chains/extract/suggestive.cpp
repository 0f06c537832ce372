// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/extract/suggestive.hpp"

#include <cmath>

#include "shaders/view_bends_comp.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {

std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                   std::span<const Bending> bendings)
{
    std::vector<shared::VertexBending> result(bendings.size());
    for (uint32_t v = 0; v < result.size(); ++v) {
        result[v].neighbor = v;
    }
    for (const glm::uvec4& corners : surface.mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = corners[k];
            const Bending& bending = bendings[v];
            if (result[v].neighbor != v || bending.normal == glm::vec3(0.0F)) {
                continue;
            }
            const glm::vec3 way = surface.positions[corners[(k + 1) % 3]] - surface.positions[v];
            const glm::vec3 flat = way - bending.normal * glm::dot(bending.normal, way);
            if (glm::length(flat) > 0.0F) {
                const Bending seen = with_tangent(bending, glm::normalize(flat));
                const float size = surface.sizes[v];
                result[v] = {corners[(k + 1) % 3], size * seen.form, size * size * seen.change};
            }
        }
    }
    return result;
}

gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame, gpu::BufferId posed_vertices,
                             gpu::BufferId bendings, uint32_t vertex_count, const SuggestiveCut& cut)
{
    auto pass = graph.compute("contour/view bends", shaders::view_bends_comp);
    pass.uniform(frame).sample(posed_vertices).sample(bendings);
    const gpu::BufferId bends =
        pass.write(graph.buffer("contour/view bends", list_of(vertex_count, sizeof(glm::vec2))));
    pass.push(shared::ViewBendConstants{.vertex_count = vertex_count,
                                        .least_growth = cut.least_growth,
                                        .least_sine = std::sin(glm::radians(cut.least_angle_deg))})
        .dispatch_items(vertex_count);
    return bends;
}

} // namespace estampe::contour
