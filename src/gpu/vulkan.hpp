// SPDX-License-Identifier: MIT
#pragma once

// The one place that includes Vulkan: volk loads it at run time, so no binary of ours links a loader, and an
// application that does so itself shares no symbol with us.

#include "gpu/volk_names.hpp"

#define VK_NO_PROTOTYPES
#include <volk.h>

namespace estampe::gpu {

/// Throws Error naming `call` when `result` is a failure; lost devices and exhausted memory are told apart.
void vk_check(VkResult result, const char* call);

} // namespace estampe::gpu
