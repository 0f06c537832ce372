// SPDX-License-Identifier: MIT
#pragma once

// Runs of 64 triangles, with a box about each: what a view cannot show is left out by these.

#include "gpu/resources.hpp"
#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// Boxes about runs of 64 triangles, one for each run of a list of `triangle_count`.
[[nodiscard]] uint64_t cluster_bounds_bytes(uint64_t triangle_count);

/// Finds the boxes anew, for triangles whose vertices have moved.
///
/// Writes  `bounds`: ClusterBounds, of cluster_bounds_bytes()
/// Cost    one dispatch: a thread per triangle, or per cluster with Tuning::threads_bound_clusters
[[nodiscard]] gpu::BufferId add_cluster_bounds(gpu::Graph& graph, const RasterInputs& in,
                                               uint32_t triangle_count, gpu::BufferId bounds,
                                               const Tuning& tuning = {});

/// The boxes of a scene, kept for as long as it stands as it did.
class ClusterBoxes {
public:
    /// Vertices have moved, or triangles are others.
    void forget() { are_found_ = false; }

    /// Finds them where they are not known. Cost: nothing, or that of add_cluster_bounds().
    [[nodiscard]] gpu::BufferId add(gpu::Graph& graph, gpu::Device& device, const RasterInputs& in,
                                    uint32_t triangle_count, const Tuning& tuning = {});

private:
    gpu::Buffer bounds_;
    bool are_found_ = false;
};

/// The clusters of a batch that the page may show, a workgroup to each: a list as shaders/tile_list.glsl.h
/// has it. None where `view` does not ask for it, see Tuning::clusters_from. Not of peels, nor of masked
/// batches.
[[nodiscard]] std::optional<gpu::BufferId> add_seen_clusters(gpu::Graph& graph, const gpu::Name& name,
                                                             const Batch& batch, const View& view,
                                                             const shared::RasterConstants& constants);

/// How many clusters the triangles of a batch lie in.
[[nodiscard]] uint32_t cluster_count(const Batch& batch);

} // namespace estampe::raster
