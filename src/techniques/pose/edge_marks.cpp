// SPDX-License-Identifier: MIT
#include "techniques/pose/mesh_data.hpp"

#include <algorithm>

namespace estampe::pose {

std::vector<uint8_t> edge_marks_of(const MeshData& meshes, const Scene& scene)
{
    const auto marks_of = [&](const DrawSource& source) -> const std::vector<uint8_t>& {
        return scene.meshes[scene.nodes[source.node].mesh].primitives[source.primitive].edge_marks;
    };
    if (std::ranges::all_of(meshes.sources,
                            [&](const DrawSource& source) { return marks_of(source).empty(); })) {
        return {};
    }
    // However triangles were sorted, those of one draw have kept their order.
    std::vector<size_t> seen_of_draw(meshes.draws.size(), 0);
    std::vector<uint8_t> marks(meshes.triangles.size(), 0);
    for (size_t t = 0; t < meshes.triangles.size(); ++t) {
        const uint32_t draw = meshes.triangles[t].w & shared::triangle_draw_mask;
        if (draw < meshes.sources.size() && !marks_of(meshes.sources[draw]).empty()) {
            const uint8_t marked = marks_of(meshes.sources[draw]).at(seen_of_draw[draw]++);
            marks[t] = static_cast<uint8_t>(marked | marks_edges);
        }
    }
    return marks;
}

} // namespace estampe::pose
