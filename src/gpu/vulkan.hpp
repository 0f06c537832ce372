// SPDX-License-Identifier: MIT
#pragma once

// The only header that includes Vulkan. volk loads Vulkan at run time, so binaries do not link a loader, and
// share no symbols with an application that links one.

#include "gpu/volk_names.hpp"

#define VK_NO_PROTOTYPES
#include <volk.h>

namespace estampe::gpu {

/// Throws Error that names `call` if `result` is a failure. A lost device and exhausted memory have their
/// own messages.
void vk_check(VkResult result, const char* call);

} // namespace estampe::gpu
