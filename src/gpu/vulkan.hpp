// SPDX-License-Identifier: MIT
#pragma once

// The one place that includes Vulkan: volk loads it at run time, so no binary of ours links a loader.

#define VK_NO_PROTOTYPES
#include <volk.h>

namespace estampe::gpu {

/// Throws Error naming `call` when `result` is a failure; lost devices and exhausted memory are told apart.
void vk_check(VkResult result, const char* call);

} // namespace estampe::gpu
