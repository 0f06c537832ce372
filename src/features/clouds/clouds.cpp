// SPDX-License-Identifier: MIT
#include "features/clouds/clouds.hpp"

#include "gpu/mapped_buffer.hpp"

namespace estampe::features {

void refill_clouds(gpu::Device& device, const sky::CloudPlan& plan, CloudBuffers& buffers)
{
    gpu::refill(device, "clouds", std::span(&plan.globals, 1), buffers.globals);
    if (buffers.shapes == plan.shapes) {
        return;
    }
    buffers.shapes = plan.shapes;
    gpu::refill(device, "cloud cells", plan.shapes->starts, buffers.starts);
    gpu::refill(device, "puffs", plan.shapes->puffs, buffers.puffs);
    gpu::refill(device, "streaks", plan.shapes->streaks, buffers.streaks);
}

} // namespace estampe::features
