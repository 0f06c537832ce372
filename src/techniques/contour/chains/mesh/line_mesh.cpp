// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/line_mesh.hpp"

#include <algorithm>

#include "gpu/upload.hpp"

namespace estampe::contour {
namespace {

/// Every edge between two triangles that no feature has taken.
std::vector<glm::uvec2> all_loose_edges(const EdgeMesh& mesh, const FeatureChains& features)
{
    std::vector<uint32_t> lined;
    lined.reserve(features.points.size());
    for (const shared::FeaturePoint& point : features.points) {
        lined.push_back(point.side);
    }
    std::sort(lined.begin(), lined.end());
    std::vector<glm::uvec2> edges;
    for (uint32_t t = 0; t < mesh.neighbors.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t side = side_of(t, k);
            const uint32_t beyond = mesh.neighbors[t][static_cast<int>(k)];
            if (beyond != no_side && side < beyond && !std::binary_search(lined.begin(), lined.end(), side) &&
                !std::binary_search(lined.begin(), lined.end(), beyond)) {
                edges.emplace_back(side, beyond);
            }
        }
    }
    return edges;
}

std::vector<uint32_t> edges_of_sides(const EdgeMesh& mesh, const std::vector<glm::uvec2>& edges)
{
    if (edges.empty()) {
        return {};
    }
    std::vector<uint32_t> of_side(3 * mesh.triangles.size(), no_side);
    for (uint32_t i = 0; i < edges.size(); ++i) {
        for (const uint32_t side : {edges[i].x, edges[i].y}) {
            of_side[3 * size_t{side >> 2U} + (side & 3U)] = i;
        }
    }
    return of_side;
}

} // namespace

LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                          const std::vector<shared::VertexBending>& bendings, bool along_edges)
{
    if (along_edges) {
        features.loose_edges = all_loose_edges(mesh, features);
    }
    LineMesh lines;
    lines.triangles = gpu::upload_buffer(device, "line triangles", mesh.triangles);
    lines.neighbors = gpu::upload_buffer(device, "line neighbors", mesh.neighbors);
    lines.loose_edges = gpu::upload_buffer(device, "loose edges", features.loose_edges);
    lines.loose_edge_of_side =
        gpu::upload_buffer(device, "loose edges of sides", edges_of_sides(mesh, features.loose_edges));
    lines.feature_points = gpu::upload_buffer(device, "feature points", features.points);
    lines.feature_chains = gpu::upload_buffer(device, "feature chains", features.chains);
    if (!bendings.empty()) {
        lines.bendings = gpu::upload_buffer(device, "bendings", bendings);
        lines.bending_count = static_cast<uint32_t>(bendings.size());
    }
    lines.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
    lines.loose_edge_count = static_cast<uint32_t>(features.loose_edges.size());
    lines.feature_point_count = static_cast<uint32_t>(features.points.size());
    lines.feature_chain_count = static_cast<uint32_t>(features.chains.size());
    lines.features_leave_edges = features.leave_edges;
    lines.shell_count = mesh.shell_count;
    return lines;
}

} // namespace estampe::contour
