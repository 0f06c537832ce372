// SPDX-License-Identifier: MIT
#include "features/lines/line_meshes.hpp"

#include <map>

#include "core/at_once.hpp"
#include "techniques/contour/chains/extract/suggestive.hpp"

namespace estampe::features {
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

/// What bends is measured against all of its object, in the units of the rest pose.
std::vector<float> sizes_of_objects(const pose::MeshData& layout)
{
    const std::vector<uint32_t> body_of_draw = bodies_of_draws(layout);
    std::vector<Bounds> bounds(layout.draws.size()); // as many bodies at most
    for (size_t v = 0; v < layout.draw_of_vertex.size(); ++v) {
        const uint32_t body = body_of_draw[layout.draw_of_vertex[v]];
        if (body != contour::no_side) {
            bounds[body].extend(layout.stroke_coordinates[v]);
        }
    }
    std::vector<float> sizes;
    sizes.reserve(layout.draw_of_vertex.size());
    for (const uint32_t draw : layout.draw_of_vertex) {
        const bool has_lines =
            body_of_draw[draw] != contour::no_side && (layout.draws[draw].flags & shared::draw_is_cut) == 0;
        sizes.push_back(has_lines ? static_cast<float>(2.0 * bounds[body_of_draw[draw]].radius()) : 0.0F);
    }
    return sizes;
}

/// One a triangle: 1 if its corners run clockwise as seen from where its normals point.
std::vector<uint8_t> clockwise_triangles(const pose::MeshData& layout)
{
    std::vector<uint8_t> clockwise;
    clockwise.reserve(layout.triangles.size());
    for (const glm::uvec4& triangle : layout.triangles) {
        const shared::DrawRecord& draw = layout.draws[triangle.w & shared::triangle_draw_mask];
        const auto rest = [&](int k) -> const shared::RestVertex& {
            return layout.rest_vertices[draw.first_rest_vertex + triangle[k] - draw.first_posed_vertex];
        };
        const glm::vec3 a = rest(0).position;
        const glm::vec3 face = glm::cross(rest(1).position - a, rest(2).position - a);
        glm::vec3 normal(0.0F);
        for (int k = 0; k < 3; ++k) {
            normal += pose::unpack_normal(rest(k).normal);
        }
        const bool is_mirrored = (triangle.w & shared::triangle_mirrored) != 0;
        clockwise.push_back((glm::dot(face, normal) < 0.0F) != is_mirrored ? 1 : 0);
    }
    return clockwise;
}

bool has_chains(const pose::MeshData& layout, const contour::ContourStyle& style)
{
    return style.drawn && style.lines == contour::Lines::chains && !layout.triangles.empty();
}

} // namespace

contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout)
{
    std::vector<glm::vec3> mesh_positions;
    std::vector<glm::vec3> mesh_normals;
    mesh_positions.reserve(layout.draw_of_vertex.size());
    mesh_normals.reserve(layout.draw_of_vertex.size());
    for (uint32_t v = 0; v < layout.draw_of_vertex.size(); ++v) {
        const shared::DrawRecord& draw = layout.draws[layout.draw_of_vertex[v]];
        const shared::RestVertex& rest =
            layout.rest_vertices[draw.first_rest_vertex + v - draw.first_posed_vertex];
        mesh_positions.push_back(rest.position);
        mesh_normals.push_back(pose::unpack_normal(rest.normal));
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
                                     .mesh_positions = mesh_positions,
                                     .mesh_normals = mesh_normals,
                                     .bodies = bodies,
                                     .materials = materials,
                                     .edge_marks = layout.edge_marks});
}

std::future<void> LineMeshes::find_edges(const pose::MeshData& layout, const contour::ContourStyle& style)
{
    if (edges_ || !has_chains(layout, style)) {
        return {};
    }
    return std::async(at_once, [this, &layout] { edges_ = edge_mesh_of(layout); });
}

contour::LineMesh* LineMeshes::ensure(gpu::Device& device, const pose::MeshData& layout,
                                      const contour::ContourStyle& style)
{
    if (!has_chains(layout, style)) {
        return nullptr;
    }
    if (!edges_) {
        edges_ = edge_mesh_of(layout);
    }
    const auto has = [&](uint32_t kind) { return contour::has_lines(style, kind); };
    const Choice choice{.features = {.crease_deg = style.crease_deg, .marked = has(shared::line_marked)},
                        .ridges = {has(shared::line_ridge), has(shared::line_valley), style.ridge_deg},
                        .along_edges = style.silhouettes == contour::Silhouettes::edges,
                        .suggestive = has(shared::line_suggestive)};
    if (!lines_ || choice_ != choice) {
        make_lines(device, layout, choice);
        choice_ = choice;
    }
    return &*lines_;
}

void LineMeshes::make_lines(gpu::Device& device, const pose::MeshData& layout, const Choice& choice)
{
    contour::FeatureChains features =
        contour::string_features(*edges_, layout.stroke_coordinates, choice.features);
    std::vector<shared::VertexBending> vertex_bendings;
    if (choice.ridges.ridges || choice.ridges.valleys || choice.suggestive) {
        const std::vector<float> sizes = sizes_of_objects(layout);
        const std::vector<uint8_t> clockwise = clockwise_triangles(layout);
        const contour::RestSurface surface{*edges_, layout.stroke_coordinates, sizes, clockwise};
        if (!bendings_) {
            bendings_ = contour::find_bending(surface);
        }
        contour::add_ridges(surface, *bendings_, choice.ridges, features);
        if (choice.suggestive) {
            vertex_bendings = contour::vertex_bendings(surface, *bendings_);
        }
    }
    lines_ =
        contour::upload_line_mesh(device, *edges_, std::move(features), vertex_bendings, choice.along_edges);
}

void LineMeshes::forget()
{
    edges_.reset();
    bendings_.reset();
    lines_.reset();
    choice_.reset();
}

} // namespace estampe::features
