// SPDX-License-Identifier: MIT
#include "techniques/raster/clusters/clusters.hpp"

#include <algorithm>

#include "gpu/fills.hpp"
#include "gpu/imports.hpp"
#include "shaders/cluster_bounds_comp.hpp"
#include "shaders/cull_clusters_comp.hpp"

namespace estampe::raster {

uint64_t cluster_bounds_bytes(uint64_t triangle_count)
{
    const uint64_t count = (triangle_count + shared::cluster_triangles - 1) / shared::cluster_triangles;
    return std::max<uint64_t>(count * sizeof(shared::ClusterBounds), 16);
}

gpu::BufferId add_cluster_bounds(gpu::Graph& graph, const RasterInputs& in, uint32_t triangle_count,
                                 gpu::BufferId bounds, const Tuning& tuning)
{
    auto pass = graph.compute("cluster bounds", shaders::cluster_bounds_comp);
    pass.sample(in.triangles).sample(in.posed_vertices);
    bounds = pass.write(bounds);
    pass.variant(tuning.threads_bound_clusters ? shared::bounds_by_thread : 0U).push(triangle_count);
    pass.dispatch_items(tuning.threads_bound_clusters
                            ? (triangle_count + shared::cluster_triangles - 1) / shared::cluster_triangles
                            : triangle_count);
    return bounds;
}

gpu::BufferId ClusterBoxes::add(gpu::Graph& graph, gpu::Device& device, const RasterInputs& in,
                                uint32_t triangle_count, const Tuning& tuning)
{
    const uint64_t size_bytes = cluster_bounds_bytes(triangle_count);
    if (bounds_.size_bytes() < size_bytes) {
        bounds_ = gpu::Buffer(device, "cluster bounds", size_bytes, gpu::MemoryUse::device);
        are_found_ = false;
    }
    const gpu::BufferId bounds = gpu::import_whole(graph, "cluster bounds", bounds_);
    if (are_found_) {
        return bounds;
    }
    are_found_ = true;
    return add_cluster_bounds(graph, in, triangle_count, bounds, tuning);
}

uint32_t cluster_count(const Batch& batch)
{
    const uint32_t last = batch.first_triangle + batch.triangle_count - 1;
    return last / shared::cluster_triangles - batch.first_triangle / shared::cluster_triangles + 1;
}

std::optional<gpu::BufferId> add_seen_clusters(gpu::Graph& graph, const gpu::Name& name, const Batch& batch,
                                               const View& view, const shared::RasterConstants& constants)
{
    if (!view.cluster_bounds || view.behind || batch.masked ||
        batch.triangle_count < view.tuning.clusters_from) {
        return std::nullopt;
    }
    const uint32_t clusters = cluster_count(batch);
    const gpu::BufferId none = gpu::add_empty_group_list(graph, name + "/no clusters", clusters);
    auto pass = graph.compute(name + "/clusters", shaders::cull_clusters_comp);
    pass.read(*view.cluster_bounds);
    const gpu::BufferId list = pass.modify(none);
    pass.push(constants).dispatch_items(clusters);
    return list;
}

} // namespace estampe::raster
