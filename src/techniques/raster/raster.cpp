// SPDX-License-Identifier: MIT
#include "techniques/raster/raster.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/cluster_bounds_comp.hpp"
#include "shaders/cull_clusters_comp.hpp"
#include "shaders/cull_clusters_seen_comp.hpp"
#include "shaders/depth_part_comp.hpp"
#include "shaders/seen_tiles_comp.hpp"
#include "techniques/raster/paths.hpp"
#include "techniques/raster/raster.glsl.h"

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
    // Smaller batches are drawn sooner than a list of their clusters is made.
    constexpr uint32_t least_triangles = 8192;
    const uint32_t listed_from =
        view.seen_clusters ? std::min(view.tuning.clusters_from, least_triangles) : view.tuning.clusters_from;
    if (!view.cluster_bounds || view.behind || batch.masked || batch.triangle_count < listed_from) {
        return std::nullopt;
    }
    const uint32_t clusters = cluster_count(batch);
    const gpu::BufferId none = gpu::add_empty_group_list(graph, name + "/no clusters", clusters);
    auto pass = graph.compute(name + "/clusters", view.seen_clusters ? shaders::cull_clusters_seen_comp
                                                                     : shaders::cull_clusters_comp);
    pass.read(*view.cluster_bounds);
    const gpu::BufferId list = pass.modify(none);
    if (view.seen_clusters) {
        pass.read(*view.seen_clusters);
    }
    pass.push(constants).dispatch_items(clusters);
    return list;
}

namespace {

gpu::BufferId add_part(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId picture, uint32_t width_px,
                       const DepthPart& part, uint32_t row_texels, gpu::BufferId map)
{
    auto pass = graph.compute(name + "/part", shaders::depth_part_comp);
    pass.sample(picture, gpu::Format::r32f);
    const gpu::BufferId filled = pass.modify(map);
    pass.push(shared::DepthPartConstants{.from_px = part.from_px,
                                         .size_px = part.size_px,
                                         .picture_width_px = width_px,
                                         .row_texels = row_texels,
                                         .first_texel = part.first_texel})
        .dispatch_over(part.size_px.x, part.size_px.y);
    return filled;
}

gpu::BufferId draw(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                   std::span<const Batch> batches, const View& view, gpu::BufferId target, bool depth_only)
{
    if (std::ranges::none_of(batches, &Batch::triangle_count)) {
        return add_clear(graph, name, target);
    }
    const auto by_path = view.path == RasterPath::hardware ? draw_by_hardware : draw_by_compute;
    return by_path(graph, name, in, batches, view, target, depth_only);
}

} // namespace

RasterInputs unmasked_inputs(gpu::Graph& graph, gpu::BufferId triangles, gpu::BufferId posed_vertices)
{
    const gpu::ImageId no_texture = graph.image("no texture", {.width = 1, .height = 1});
    return {.triangles = triangles,
            .posed_vertices = posed_vertices,
            .draws = triangles,
            .rest_vertices = posed_vertices,
            .materials = triangles,
            .textures = {no_texture, no_texture, no_texture, no_texture, no_texture}};
}

gpu::BufferId add_visibility(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                             std::span<const Batch> batches, const View& view)
{
    const glm::uvec2 drawn_px = view.drawn_px();
    const uint64_t size_bytes = sizeof(uint64_t) * drawn_px.x * drawn_px.y;
    const gpu::BufferId target = graph.buffer(name, {.size_bytes = (size_bytes + 15) / 16 * 16});
    return draw(graph, name, in, batches, view, target, false);
}

std::vector<gpu::BufferId> add_layers(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                      std::span<const Batch> batches, View view, uint32_t count)
{
    std::vector<gpu::BufferId> layers{add_visibility(graph, name, in, batches, view)};
    while (layers.size() < count) {
        view.behind = layers.back();
        layers.push_back(
            add_visibility(graph, fmt::format("{}/{}", name.view(), layers.size()), in, batches, view));
    }
    return layers;
}

gpu::BufferId add_depth(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                        std::span<const Batch> batches, const View& view, gpu::BufferId target)
{
    return draw(graph, name, in, batches, view, target, true);
}

gpu::BufferId add_depth_parts(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                              std::span<const Batch> batches, const View& view,
                              const std::vector<DepthPart>& parts, uint32_t row_texels, gpu::BufferId map)
{
    const auto holds_any = [](const Batch& batch) { return batch.triangle_count > 0; };
    if (view.path == RasterPath::hardware && std::ranges::any_of(batches, holds_any)) {
        return draw_parts_by_hardware(graph, name, in, batches, view, parts, row_texels, map);
    }
    const uint64_t size_bytes = sizeof(uint32_t) * uint64_t{view.size_px.x} * view.size_px.y;
    const gpu::BufferId picture =
        draw(graph, name, in, batches, view,
             graph.buffer(name + "/picture", {.size_bytes = (size_bytes + 15) / 16 * 16}), true);
    for (const DepthPart& part : parts) {
        map = add_part(graph, name, picture, view.size_px.x, part, row_texels, map);
    }
    return map;
}

gpu::BufferId add_seen_tiles(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId visibility,
                             glm::uvec2 size_px)
{
    const glm::uvec2 tiles = (size_px + 7U) / 8U;
    const gpu::BufferId none = gpu::add_empty_tile_list(graph, "seen tiles", size_px);
    auto pass = graph.compute(name + "/tiles", shaders::seen_tiles_comp);
    pass.sample(visibility, gpu::Format::rg32ui);
    const gpu::BufferId seen = pass.modify(none);
    pass.push(size_px).dispatch_over(tiles.x, tiles.y);
    return seen;
}

Tuning tuning_of(const gpu::ExecutionProfile& execution)
{
    if (!execution.is_processor) {
        return {};
    }
    // On a CPU device, one thread draws a fairly large triangle faster than many threads share its tiles.
    return {.small_area_px = 2048,
            .list_groups = 32,
            .threads_list_tiles = false,
            .clusters_from = 8192,
            .threads_bound_clusters = true};
}

} // namespace estampe::raster
