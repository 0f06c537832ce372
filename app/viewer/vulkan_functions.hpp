// SPDX-License-Identifier: MIT
#pragma once

// The window has a Vulkan device of its own, beside the renderer's. Its functions are kept apart from those
// that the library loads, which a second instance would replace while the first draws.

#include "gpu/vulkan.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace estampe::viewer {

// NOLINTBEGIN(bugprone-macro-parentheses)
#define VIEWER_INSTANCE_FUNCTIONS(each)                                                                      \
    each(DestroyInstance) each(EnumeratePhysicalDevices) each(GetPhysicalDeviceProperties)                   \
        each(GetPhysicalDeviceFeatures2) each(GetPhysicalDeviceMemoryProperties)                             \
            each(GetPhysicalDeviceQueueFamilyProperties) each(GetPhysicalDeviceSurfaceSupportKHR)            \
                each(GetPhysicalDeviceSurfaceCapabilitiesKHR) each(GetPhysicalDeviceSurfaceFormatsKHR)       \
                    each(DestroySurfaceKHR) each(CreateDevice) each(GetDeviceProcAddr)

#define VIEWER_DEVICE_FUNCTIONS(each)                                                                        \
    each(DestroyDevice) each(GetDeviceQueue) each(DeviceWaitIdle) each(QueueSubmit2) each(QueuePresentKHR)   \
        each(CreateSwapchainKHR) each(DestroySwapchainKHR) each(GetSwapchainImagesKHR) each(                 \
            AcquireNextImageKHR) each(CreateImage) each(DestroyImage) each(GetImageMemoryRequirements)       \
            each(BindImageMemory) each(CreateImageView) each(DestroyImageView) each(CreateBuffer) each(      \
                DestroyBuffer) each(GetBufferMemoryRequirements) each(BindBufferMemory) each(AllocateMemory) \
                each(FreeMemory) each(MapMemory) each(CreateSampler) each(DestroySampler)                    \
                    each(CreateShaderModule) each(DestroyShaderModule) each(CreateDescriptorSetLayout) each( \
                        DestroyDescriptorSetLayout) each(CreateDescriptorPool) each(DestroyDescriptorPool)   \
                        each(AllocateDescriptorSets) each(FreeDescriptorSets) each(UpdateDescriptorSets)     \
                            each(CreatePipelineLayout) each(DestroyPipelineLayout)                           \
                                each(CreateGraphicsPipelines) each(DestroyPipeline) each(CreateCommandPool)  \
                                    each(DestroyCommandPool) each(AllocateCommandBuffers)                    \
                                        each(BeginCommandBuffer) each(EndCommandBuffer)                      \
                                            each(ResetCommandPool) each(CreateFence) each(DestroyFence)      \
                                                each(WaitForFences) each(ResetFences) each(CreateSemaphore)  \
                                                    each(DestroySemaphore) each(CmdPipelineBarrier2)         \
                                                        each(CmdCopyBufferToImage) each(CmdBeginRendering)   \
                                                            each(CmdEndRendering) each(CmdBindPipeline)      \
                                                                each(CmdBindDescriptorSets)                  \
                                                                    each(CmdBindVertexBuffers)               \
                                                                        each(CmdBindIndexBuffer)             \
                                                                            each(CmdPushConstants)           \
                                                                                each(CmdSetViewport)         \
                                                                                    each(CmdSetScissor)      \
                                                                                        each(CmdDrawIndexed)

struct InstanceFunctions {
#define VIEWER_DECLARE(name) PFN_vk##name name = nullptr;
    VIEWER_INSTANCE_FUNCTIONS(VIEWER_DECLARE)
};

struct DeviceFunctions {
    VIEWER_DEVICE_FUNCTIONS(VIEWER_DECLARE)
#undef VIEWER_DECLARE
};

// NOLINTEND(bugprone-macro-parentheses)

/// Of an instance that GLFW's loader made.
[[nodiscard]] InstanceFunctions load_functions(VkInstance instance);
[[nodiscard]] DeviceFunctions load_functions(const InstanceFunctions& vk, VkDevice device);

} // namespace estampe::viewer
