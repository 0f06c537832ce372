// SPDX-License-Identifier: MIT
#include "features/culling/culling.hpp"

#include <algorithm>

#include "techniques/raster/raster.glsl.h"

namespace estampe::features {

std::vector<std::optional<Bounds>> still_boxes(const pose::MeshData& layout)
{
    const size_t count = layout.triangles.size();
    std::vector<bool> is_still(count, false);
    for (const pose::CasterRun& run : layout.casters) {
        const auto first = is_still.begin() + run.range.first;
        std::fill(first, first + run.range.count, !run.moves);
    }
    std::vector<std::optional<Bounds>> boxes;
    for (size_t first = 0; first < count; first += shared::cluster_triangles) {
        const size_t end = std::min<size_t>(first + shared::cluster_triangles, count);
        const auto still_at = [&](size_t i) { return is_still.begin() + static_cast<std::ptrdiff_t>(i); };
        if (std::find(still_at(first), still_at(end), false) != still_at(end)) {
            boxes.emplace_back();
            continue;
        }
        Bounds& bounds = boxes.emplace_back(Bounds()).value();
        for (size_t i = first; i < end; ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 place(layout.stroke_coordinates[layout.triangles[i][corner]]);
                bounds.extend(layout.rest_anchor + layout.stroke_unit_m * place);
            }
        }
    }
    return boxes;
}

void Culling::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        clusters_.reset();
    }
}

std::optional<gpu::BufferId> Culling::record(gpu::Graph& graph, gpu::Device& device, const CullingInputs& in)
{
    const auto eye = cells::eye_of(in.clip_from_anchor, in.layout.anchor, in.size_px);
    if (!eye) {
        return std::nullopt;
    }
    if (!clusters_) {
        clusters_.emplace(in.scene.cells, still_boxes(in.layout));
    }
    seen_.find(in.scene.cells, in.scene.portals, *eye);
    clusters_->find_seen(*eye, seen_, bits_);
    gpu::upload_items(device, "clusters in sight", bits_, buffer_);
    return gpu::import_whole(graph, "clusters in sight", buffer_);
}

} // namespace estampe::features
