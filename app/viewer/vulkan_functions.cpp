// SPDX-License-Identifier: MIT
#include "viewer/vulkan_functions.hpp"

namespace estampe::viewer {

InstanceFunctions load_functions(VkInstance instance)
{
    InstanceFunctions vk;
#define VIEWER_LOAD(name)                                                                                    \
    vk.name = reinterpret_cast<PFN_vk##name>(glfwGetInstanceProcAddress(instance, "vk" #name));
    VIEWER_INSTANCE_FUNCTIONS(VIEWER_LOAD)
#undef VIEWER_LOAD
    return vk;
}

DeviceFunctions load_functions(const InstanceFunctions& vk, VkDevice device)
{
    DeviceFunctions made;
#define VIEWER_LOAD(name)                                                                                    \
    made.name = reinterpret_cast<PFN_vk##name>(vk.GetDeviceProcAddr(device, "vk" #name));
    VIEWER_DEVICE_FUNCTIONS(VIEWER_LOAD)
#undef VIEWER_LOAD
    return made;
}

} // namespace estampe::viewer
