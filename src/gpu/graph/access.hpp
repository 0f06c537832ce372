// SPDX-License-Identifier: MIT
#pragma once

#include "gpu/graph/compile.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

struct StageAccess {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// Vulkan's pipeline stage and access mask of an access.
[[nodiscard]] StageAccess stage_access(Access access);

/// The union over a set; nothing at all for the empty set.
[[nodiscard]] StageAccess stage_access(AccessSet accesses);

[[nodiscard]] VkImageLayout vulkan_layout(Layout layout);

} // namespace estampe::gpu
