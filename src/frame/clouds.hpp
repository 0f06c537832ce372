// SPDX-License-Identifier: MIT
#pragma once

// What the clouds of a picture are drawn from.

#include "gpu/resources.hpp"
#include "techniques/sky/clouds/clouds.hpp"

namespace estampe::frame {

/// The clouds of a plan.
struct CloudBuffers {
    gpu::Buffer globals;
    gpu::Buffer starts;
    gpu::Buffer puffs;
    gpu::Buffer streaks;
};

[[nodiscard]] CloudBuffers cloud_buffers(gpu::Device& device, const sky::CloudPlan& plan);

} // namespace estampe::frame
