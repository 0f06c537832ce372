// SPDX-License-Identifier: MIT
#include "techniques/raster/passes.hpp"

#include <algorithm>
#include <utility>

#include "shaders/bin_behind_comp.hpp"
#include "shaders/bin_depth_comp.hpp"
#include "shaders/bin_depth_masked_comp.hpp"
#include "shaders/bin_ids_comp.hpp"
#include "shaders/bin_masked_comp.hpp"
#include "shaders/clear_counted_comp.hpp"
#include "shaders/small_behind_comp.hpp"
#include "shaders/small_depth_comp.hpp"
#include "shaders/small_depth_masked_comp.hpp"
#include "shaders/small_ids_comp.hpp"
#include "shaders/small_ids_listed_comp.hpp"
#include "shaders/small_masked_comp.hpp"
#include "shaders/tile_behind_comp.hpp"
#include "shaders/tile_depth_comp.hpp"
#include "shaders/tile_depth_masked_comp.hpp"
#include "shaders/tile_ids_comp.hpp"
#include "shaders/tile_masked_comp.hpp"
#include "techniques/raster/clusters/clusters.hpp"
#include "techniques/raster/raster.glsl.h"

namespace estampe::raster {
namespace {

struct Stages {
    const gpu::Shader& small;
    const gpu::Shader& bin;
    const gpu::Shader& tile;
};

Stages stages(bool depth_only, bool masked, bool behind)
{
    if (behind) {
        return {shaders::small_behind_comp, shaders::bin_behind_comp, shaders::tile_behind_comp};
    }
    if (depth_only) {
        return masked ? Stages{shaders::small_depth_masked_comp, shaders::bin_depth_masked_comp,
                               shaders::tile_depth_masked_comp}
                      : Stages{shaders::small_depth_comp, shaders::bin_depth_comp, shaders::tile_depth_comp};
    }
    return masked ? Stages{shaders::small_masked_comp, shaders::bin_masked_comp, shaders::tile_masked_comp}
                  : Stages{shaders::small_ids_comp, shaders::bin_ids_comp, shaders::tile_ids_comp};
}

/// New counters of a batch, which have to be cleared.
gpu::BufferId new_counters(gpu::Graph& graph, const gpu::Name& name)
{
    return graph.buffer(name + "/counters", {.size_bytes = (sizeof(shared::RasterCounters) + 15) / 16 * 16});
}

/// Clears `target` and `counters`, and makes new versions of them.
void add_clear_of_both(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId& target,
                       gpu::BufferId& counters)
{
    const auto quad_count = static_cast<uint32_t>(graph.describe(target).size_bytes / 16);
    auto pass = graph.compute(name + "/clear", shaders::clear_counted_comp);
    target = pass.write(target);
    counters = pass.write(counters);
    pass.push(quad_count).dispatch_items((quad_count + 255) / 256 * 64);
}

gpu::BufferId add_batch(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in, const Batch& batch,
                        const View& view, gpu::BufferId target, gpu::BufferId counters, bool depth_only)
{
    const uint32_t large_capacity = 2 * batch.triangle_count; // clipping makes two of one at most
    const glm::uvec2 page_tiles = (view.size_px + shared::raster_tile_px - 1U) / shared::raster_tile_px;
    const auto tile_capacity = static_cast<uint32_t>(
        std::min(most_tiles, static_cast<uint64_t>(large_capacity) * page_tiles.x * page_tiles.y));
    const shared::RasterConstants constants{.clip_from_anchor = view.clip_from_anchor,
                                            .size_px = view.size_px,
                                            .first_triangle = batch.first_triangle,
                                            .triangle_count = batch.triangle_count,
                                            .large_capacity = large_capacity,
                                            .tile_capacity = tile_capacity,
                                            .cull_back_faces = view.cull_back_faces ? 1U : 0U,
                                            .small_area_px = view.tuning.small_area_px,
                                            .second = second_bits(view)};
    const auto clusters = depth_only ? std::nullopt : add_seen_clusters(graph, name, batch, view, constants);
    const Stages shaders = stages(depth_only, batch.masked, view.behind.has_value());
    const gpu::Shader& small = clusters ? shaders::small_ids_listed_comp : shaders.small;
    gpu::BufferId large =
        graph.buffer(name + "/large", {.size_bytes = large_capacity * sizeof(shared::LargeTriangle)});
    gpu::BufferId tiles =
        graph.buffer(name + "/tiles", {.size_bytes = tile_capacity * sizeof(shared::TriangleTile)});
    const auto begin_stage = [&](const char* stage, const gpu::Shader& shader) {
        auto pass = graph.compute(name + "/" + stage, shader);
        pass.sample(in.triangles).sample(in.posed_vertices);
        const bool first = &shader == &small;
        counters = pass.modify(counters);
        large = first ? pass.write(large) : pass.modify(large);
        tiles = first ? pass.write(tiles) : pass.modify(tiles);
        target = pass.modify(target);
        if (batch.masked || view.behind) {
            bind_masks(pass, in);
        }
        pass.variant(mask_variant(in, batch, view) |
                     (first && view.tuning.threads_list_tiles ? shared::draw_lists_tiles : 0U));
        if (view.behind) {
            pass.sample(*view.behind, gpu::Format::rg32ui);
        }
        pass.push(constants);
        return pass;
    };
    if (clusters) {
        begin_stage("small", small).read(*clusters).dispatch_indirect(*clusters);
    } else {
        begin_stage("small", small).dispatch_items(batch.triangle_count);
    }
    begin_stage("bin", shaders.bin).dispatch(std::min(view.tuning.list_groups, large_capacity));
    begin_stage("tile", shaders.tile)
        .dispatch(std::max(view.tuning.list_groups, tile_capacity / most_tiles_a_group + 1));
    return target;
}

} // namespace

gpu::BufferId draw_by_compute(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                              std::span<const Batch> batches, const View& view, gpu::BufferId target,
                              bool depth_only)
{
    gpu::BufferId counters = new_counters(graph, name);
    add_clear_of_both(graph, name, target, counters);
    bool is_first = true;
    for (const Batch& batch : batches) {
        if (batch.triangle_count == 0) {
            continue;
        }
        const gpu::Name of_batch = name + (batch.masked ? "/masked" : "");
        if (!std::exchange(is_first, false)) {
            counters = add_clear(graph, of_batch + "/counters", new_counters(graph, of_batch));
        }
        target = add_batch(graph, of_batch, in, batch, view, target, counters, depth_only);
    }
    return target;
}

} // namespace estampe::raster
