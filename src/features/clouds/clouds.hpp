// SPDX-License-Identifier: MIT
#pragma once

// What the clouds of a picture are drawn from.

#include "gpu/resources.hpp"
#include "techniques/sky/clouds/clouds.hpp"

namespace estampe::features {

/// The clouds of a plan.
struct CloudBuffers {
    std::shared_ptr<const sky::CloudShapes> shapes; ///< what starts, puffs and streaks hold
    gpu::Buffer globals;
    gpu::Buffer starts;
    gpu::Buffer puffs;
    gpu::Buffer streaks;
};

/// Brings the clouds of a plan to the device; shapes only where they are others than before.
void refill_clouds(gpu::Device& device, const sky::CloudPlan& plan, CloudBuffers& buffers);

} // namespace estampe::features
