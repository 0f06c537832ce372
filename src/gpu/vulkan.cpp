// SPDX-License-Identifier: MIT
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#endif
#define VOLK_IMPLEMENTATION
#include "gpu/vulkan.hpp"
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::gpu {

void vk_check(VkResult result, const char* call)
{
    switch (result) {
    case VK_SUCCESS:
        return;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        throw Error("out of graphics memory", call,
                    "try a smaller --size, fewer smoke.cells, or a lighter scene");
    case VK_ERROR_DEVICE_LOST:
        throw DeviceLost("the graphics device was lost", call, "try again, or --device cpu");
    default:
        throw Error(fmt::format("Vulkan failed with code {}", static_cast<int>(result)), call,
                    "choose another --device that estampe devices lists");
    }
}

} // namespace estampe::gpu
