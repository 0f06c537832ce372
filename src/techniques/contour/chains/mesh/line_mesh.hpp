// SPDX-License-Identifier: MIT
#pragma once

#include "gpu/resources.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"
#include "techniques/contour/chains/mesh/feature_chains.hpp"

namespace estampe::contour {

/// What lines are strung along, on the device.
struct LineMesh {
    gpu::Buffer triangles; ///< EdgeMesh::triangles
    gpu::Buffer neighbors;
    gpu::Buffer loose_edges;        ///< both sides of each
    gpu::Buffer loose_edge_of_side; ///< three a triangle; of no use where there are no loose edges
    gpu::Buffer feature_points;
    gpu::Buffer feature_chains;
    gpu::Buffer bendings; ///< VertexBending, for suggestive contours; empty without them
    uint32_t triangle_count = 0;
    uint32_t loose_edge_count = 0;
    uint32_t feature_point_count = 0;
    uint32_t feature_chain_count = 0;
    uint32_t bending_count = 0;        ///< vertices, or none
    uint32_t shell_count = 0;          ///< EdgeMesh::shell_count
    bool features_leave_edges = false; ///< FeatureChains::leave_edges
};

/// Uploads `mesh` with the lines of its features, and `bendings` if there are to be suggestive contours. With
/// `along_edges` every edge without a line of its own is loose, so that outlines run along the edges of the
/// mesh. Throws Error when memory runs out.
[[nodiscard]] LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                                        const std::vector<shared::VertexBending>& bendings, bool along_edges);

} // namespace estampe::contour
