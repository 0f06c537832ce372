// SPDX-License-Identifier: MIT
#include "techniques/raster/raster.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "techniques/raster/passes.hpp"

namespace estampe::raster {
namespace {

gpu::BufferId draw(gpu::Graph& graph, const std::string& name, const RasterInputs& in,
                   std::vector<Batch> batches, const View& view, gpu::BufferId target, bool depth_only)
{
    std::erase_if(batches, [](const Batch& batch) { return batch.triangle_count == 0; });
    if (batches.empty()) {
        return add_clear(graph, name, target);
    }
    const auto by_path = view.path == RasterPath::hardware ? draw_by_hardware : draw_by_compute;
    return by_path(graph, name, in, batches, view, target, depth_only);
}

} // namespace

gpu::BufferId add_visibility(gpu::Graph& graph, const std::string& name, const RasterInputs& in,
                             const std::vector<Batch>& batches, const View& view)
{
    const uint64_t size_bytes = sizeof(uint64_t) * view.size_px.x * view.size_px.y;
    const gpu::BufferId target = graph.buffer(name, {.size_bytes = (size_bytes + 15) / 16 * 16});
    return draw(graph, name, in, batches, view, target, false);
}

std::vector<gpu::BufferId> add_layers(gpu::Graph& graph, const std::string& name, const RasterInputs& in,
                                      const std::vector<Batch>& batches, View view, uint32_t count)
{
    std::vector<gpu::BufferId> layers{add_visibility(graph, name, in, batches, view)};
    while (layers.size() < count) {
        view.behind = layers.back();
        layers.push_back(add_visibility(graph, fmt::format("{}/{}", name, layers.size()), in, batches, view));
    }
    return layers;
}

gpu::BufferId add_depth(gpu::Graph& graph, const std::string& name, const RasterInputs& in,
                        const std::vector<Batch>& batches, const View& view, gpu::BufferId target)
{
    return draw(graph, name, in, batches, view, target, true);
}

} // namespace estampe::raster
