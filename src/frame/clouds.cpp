// SPDX-License-Identifier: MIT
#include "frame/clouds.hpp"

#include "frame/mapped_buffer.hpp"

namespace estampe::frame {

CloudBuffers cloud_buffers(gpu::Device& device, const sky::CloudPlan& plan)
{
    return {.globals = mapped_buffer(device, "clouds", std::span(&plan.globals, 1)),
            .starts = mapped_buffer(device, "cloud cells", plan.starts),
            .puffs = mapped_buffer(device, "puffs", plan.puffs),
            .streaks = mapped_buffer(device, "streaks", plan.streaks)};
}

} // namespace estampe::frame
