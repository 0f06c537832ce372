// SPDX-License-Identifier: MIT
#include "features/clouds/clouds.hpp"

#include "gpu/resources.hpp"

namespace estampe::features {

void Clouds::upload(gpu::Device& device, const sky::CloudPlan& plan)
{
    gpu::upload_items(device, "clouds", std::span(&plan.globals, 1), globals_);
    if (shapes_ == plan.shapes) {
        return;
    }
    shapes_ = plan.shapes;
    gpu::upload_items(device, "cloud cells", shapes_->starts, starts_);
    gpu::upload_items(device, "puffs", shapes_->puffs, puffs_);
    gpu::upload_items(device, "streaks", shapes_->streaks, streaks_);
}

sky::CloudHandles Clouds::import(gpu::Graph& graph)
{
    return {.globals = gpu::import_whole(graph, "clouds", globals_),
            .starts = gpu::import_whole(graph, "cloud cells", starts_),
            .puffs = gpu::import_whole(graph, "puffs", puffs_),
            .streaks = gpu::import_whole(graph, "streaks", streaks_)};
}

} // namespace estampe::features
