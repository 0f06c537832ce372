// SPDX-License-Identifier: MIT
#include "features/clouds/clouds.hpp"

#include "gpu/mapped_buffer.hpp"

namespace estampe::features {

void Clouds::upload(gpu::Device& device, const sky::CloudPlan& plan)
{
    gpu::refill(device, "clouds", std::span(&plan.globals, 1), globals_);
    if (shapes_ == plan.shapes) {
        return;
    }
    shapes_ = plan.shapes;
    gpu::refill(device, "cloud cells", shapes_->starts, starts_);
    gpu::refill(device, "puffs", shapes_->puffs, puffs_);
    gpu::refill(device, "streaks", shapes_->streaks, streaks_);
}

} // namespace estampe::features
