// SPDX-License-Identifier: MIT
#pragma once

// The only header that includes Vulkan. volk loads Vulkan at run time. Therefore binaries do not link a
// Vulkan loader, and share no symbols with a host application that links a loader.

#include "gpu/volk_names.hpp"

#define VK_NO_PROTOTYPES
#include <volk.h>

namespace estampe::gpu {

/// Throws an Error that names `call` if `result` is a failure code; DeviceLost if the device was lost. A lost
/// device and exhausted memory have special messages.
void vk_check(VkResult result, const char* call);

} // namespace estampe::gpu
