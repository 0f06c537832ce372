// SPDX-License-Identifier: MIT
#pragma once

// Drawing on a Vulkan device of the host application. Only this header of the library has Vulkan types.

#include <vulkan/vulkan_core.h>

#include <estampe/renderer.hpp>

namespace estampe {

/// A Vulkan device of the host application, for Renderer(const VulkanHost&). The host keeps ownership of the
/// instance, device and queue, which must outlive the renderer.
struct VulkanHost {
    /// Function of the Vulkan loader with which the instance was created; null: the loader of this machine.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE; ///< Instance for Vulkan 1.3
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE; ///< Device, created with the features of VulkanFeatures
    /// Queue that supports graphics, compute and timestamps. While the renderer is being created or draws, no
    /// other code may submit to this queue.
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
};

/// Device features for a renderer: those that it requires, and optional ones that make it faster if the
/// device has them.
///
///     estampe::VulkanFeatures features({.instance = instance, .physical_device = physical});
///     VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = features.chain(),
///     ...};
///
/// A host that needs further features sets them in the structures of the chain, because Vulkan allows each
/// structure only once. In the order of the chain they are VkPhysicalDeviceFeatures2,
/// VkPhysicalDeviceVulkan12Features and VkPhysicalDeviceVulkan13Features.
class VulkanFeatures {
public:
    /// Queries the features of `host.physical_device`; `device` and `queue` may still be null. Throws Error
    /// that says what the device lacks.
    explicit VulkanFeatures(const VulkanHost& host);
    VulkanFeatures(const VulkanFeatures&) = delete;
    VulkanFeatures& operator=(const VulkanFeatures&) = delete;

    /// Value for VkDeviceCreateInfo::pNext. Valid as long as this object exists.
    [[nodiscard]] VkPhysicalDeviceFeatures2* chain() { return &core_; }

private:
    VkPhysicalDeviceVulkan13Features v13_{};
    VkPhysicalDeviceVulkan12Features v12_{};
    VkPhysicalDeviceFeatures2 core_{};
};

/// An image of the host application, for Renderer::render_to(): 2D, one layer, one sample, format
/// VK_FORMAT_R8G8B8A8_UNORM or _SRGB (both receive the same sRGB bytes), created with
/// VK_IMAGE_USAGE_TRANSFER_DST_BIT, of the size in RenderSettings. The image may have any layout before
/// render_to(); its content is discarded. Alpha is 1, or straight if the style's paper is transparent: blend
/// with VK_BLEND_FACTOR_SRC_ALPHA, or premultiply the colours for a swapchain that requires it.
struct VulkanPicture {
    VkImage image = VK_NULL_HANDLE;
    /// Layout that the image has after render_to().
    VkImageLayout layout_after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
};

} // namespace estampe
