// SPDX-License-Identifier: MIT
#include "features/shadows/local_maps.hpp"

#include <algorithm>

#include "gpu/imports.hpp"

namespace estampe::features {
namespace {

bool counts(const pose::CasterRun& run, Casters which)
{
    return which == Casters::all || run.moves == (which == Casters::moving);
}

} // namespace

void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches)
{
    batches.clear();
    for (const pose::CasterRun& run : layout.casters) {
        if ((run.groups & groups) != 0 && counts(run, which)) {
            batches.push_back({.first_triangle = run.range.first,
                               .triangle_count = run.range.count,
                               .masked = run.masked,
                               .plain = run.range.plain,
                               .groups = run.groups});
        }
    }
}

std::vector<raster::Batch> caster_batches(const pose::MeshData& layout, Groups groups, Casters which)
{
    std::vector<raster::Batch> batches;
    list_casters(layout, groups, which, batches);
    return batches;
}

CasterKinds caster_kinds(const pose::MeshData& layout)
{
    const auto& runs = layout.casters;
    return {.moving = std::ranges::any_of(runs, [](const auto& run) { return run.moves; }),
            .still = std::ranges::any_of(runs, [](const auto& run) { return !run.moves; })};
}

gpu::BufferId add_local_maps(gpu::Graph& graph, const LocalMapInputs& in, LocalShadowBuffers& buffers)
{
    auto maps = gpu::import_whole(graph, "local shadows", buffers.maps);
    if (in.views.empty()) {
        return maps;
    }
    const auto depth_views = [&](const std::vector<shared::RasterView>& list, const char* name,
                                 gpu::Buffer& records) {
        return raster::DepthViews{.list = list,
                                  .records = gpu::import_whole(graph, name, records),
                                  .bounds = *in.cluster_bounds,
                                  .path = in.path,
                                  .tuning = in.tuning};
    };
    const auto draw = [&](const char* name, Casters which, const raster::DepthViews& views,
                          gpu::BufferId target) {
        return raster::add_depth_views(graph, name, in.raster, caster_batches(in.layout, all_groups, which),
                                       views, target);
    };
    if (!in.views.whole.empty()) {
        maps = draw("local shadows", Casters::all,
                    depth_views(in.views.whole, "local views", buffers.views.whole), maps);
    }
    if (!in.views.moving.empty()) {
        auto layers = gpu::import_whole(graph, "local layers", buffers.layers);
        if (!in.views.still.empty()) {
            layers = draw("local shadows/still", Casters::still,
                          depth_views(in.views.still, "local views/still", buffers.views.still), layers);
        }
        const raster::DepthViews views =
            depth_views(in.views.moving, "local views/moving", buffers.views.moving);
        maps = draw("local shadows/moving", Casters::moving, views, maps);
        maps = raster::add_merged_views(graph, "local shadows/merge", views, layers, maps);
    }
    return maps;
}

} // namespace estampe::features
