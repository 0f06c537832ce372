// SPDX-License-Identifier: MIT
#pragma once

// Culling by cells and portals on the page: remembers which clusters of a scene's triangles lie in which
// rooms.

#include <cstdint>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/feature.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/cells/cells.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The view that is culled, and the scene that it shows.
struct CullingInputs {
    const Scene& scene;
    const pose::MeshData& layout;
    glm::mat4 clip_from_anchor{1.0F};
    glm::uvec2 size_px{0};
};

/// Returns for each cluster of 64 triangles its box in world space. Clusters with a triangle that may move,
/// or that casts no shadow, have no box. Cost: linear in triangles.
[[nodiscard]] std::vector<std::optional<Bounds>> still_boxes(const pose::MeshData& layout);

class Culling final : public Feature {
public:
    void invalidate(Event event) override;

    /// Finds the clusters that a view may show, and uploads them as bits for raster::View::seen_clusters.
    /// Returns none for a parallel projection, in which everything is drawn.
    ///
    /// Cost    on the CPU, see cells::SeenCells and cells::CellsOfClusters; after a change of the meshes,
    ///         also linear in triangles
    [[nodiscard]] std::optional<gpu::BufferId> record(gpu::Graph& graph, gpu::Device& device,
                                                      const CullingInputs& in);

private:
    std::optional<cells::CellsOfClusters> clusters_; ///< none after a change of the meshes
    cells::SeenCells seen_;
    std::vector<uint32_t> bits_;
    gpu::Buffer buffer_;
};

} // namespace estampe::features
