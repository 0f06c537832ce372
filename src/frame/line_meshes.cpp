// SPDX-License-Identifier: MIT
#include "frame/line_meshes.hpp"

#include <map>

namespace estampe::frame {
namespace {

/// One number for each place of a node.
std::vector<uint32_t> bodies_of_draws(const pose::MeshData& layout)
{
    std::map<std::pair<Index, uint32_t>, uint32_t> numbers;
    std::vector<uint32_t> bodies;
    bodies.reserve(layout.draws.size());
    for (const pose::DrawSource& source : layout.sources) {
        const auto number = static_cast<uint32_t>(numbers.size());
        bodies.push_back(numbers.try_emplace({source.node, source.instance}, number).first->second);
    }
    bodies.resize(layout.draws.size(), contour::no_side);
    return bodies;
}

} // namespace

contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout)
{
    std::vector<glm::vec3> normals;
    normals.reserve(layout.draw_of_vertex.size());
    for (uint32_t v = 0; v < layout.draw_of_vertex.size(); ++v) {
        const shared::DrawRecord& draw = layout.draws[layout.draw_of_vertex[v]];
        const uint32_t rest = draw.first_rest_vertex + v - draw.first_posed_vertex;
        normals.push_back(pose::unpack_normal(layout.rest_vertices[rest].normal));
    }
    const std::vector<uint32_t> body_of_draw = bodies_of_draws(layout);
    std::vector<uint32_t> bodies;
    std::vector<uint32_t> materials;
    bodies.reserve(layout.triangles.size());
    materials.reserve(layout.triangles.size());
    for (uint32_t t = 0; t < layout.triangles.size(); ++t) {
        const uint32_t draw = layout.triangles[t].w & shared::triangle_draw_mask;
        const bool is_cut = (layout.draws[draw].flags & shared::draw_is_cut) != 0;
        bodies.push_back(is_cut ? contour::no_side : body_of_draw[draw]);
        materials.push_back(layout.draws[draw].material);
    }
    return contour::build_edge_mesh({.triangles = layout.triangles,
                                     .positions = layout.stroke_coordinates,
                                     .normals = normals,
                                     .bodies = bodies,
                                     .materials = materials});
}

contour::LineMesh* LineMeshes::provide(gpu::Device& device, const pose::MeshData& layout,
                                       const contour::ContourStyle& style)
{
    if (!style.drawn || style.lines != contour::Lines::chains || layout.triangles.empty()) {
        return nullptr;
    }
    if (!edges_) {
        edges_ = edge_mesh_of(layout);
    }
    const Choice choice{.features = {.crease_deg = style.crease_deg},
                        .along_edges = style.silhouettes == contour::Silhouettes::edges};
    if (!lines_ || choice_ != choice) {
        lines_ = contour::upload_line_mesh(
            device, *edges_, contour::string_features(*edges_, layout.stroke_coordinates, choice.features),
            choice.along_edges);
        choice_ = choice;
    }
    return &*lines_;
}

void LineMeshes::forget()
{
    edges_.reset();
    lines_.reset();
    choice_.reset();
}

} // namespace estampe::frame
