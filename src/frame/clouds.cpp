// SPDX-License-Identifier: MIT
#include "frame/clouds.hpp"

#include "frame/mapped_buffer.hpp"

namespace estampe::frame {

void refill_clouds(gpu::Device& device, const sky::CloudPlan& plan, CloudBuffers& buffers)
{
    refill(device, "clouds", std::span(&plan.globals, 1), buffers.globals);
    if (buffers.shapes == plan.shapes) {
        return;
    }
    buffers.shapes = plan.shapes;
    refill(device, "cloud cells", plan.shapes->starts, buffers.starts);
    refill(device, "puffs", plan.shapes->puffs, buffers.puffs);
    refill(device, "streaks", plan.shapes->streaks, buffers.streaks);
}

} // namespace estampe::frame
