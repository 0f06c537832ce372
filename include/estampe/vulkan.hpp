// SPDX-License-Identifier: MIT
#pragma once

// Drawing on a Vulkan device of the application that embeds Estampe. The one header with Vulkan's types.

#include <vulkan/vulkan_core.h>

#include <estampe/renderer.hpp>

namespace estampe {

/// A device of the host application's, for Renderer(const VulkanHost&). All of it stays the host's, and must
/// outlive the renderer.
struct VulkanHost {
    /// Of the loader that made the instance; null for the one of this machine.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE; ///< of Vulkan 1.3
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE; ///< made with the features of VulkanFeatures
    /// For drawing, computing and time stamps. While the renderer is made or draws nobody else may submit to
    /// it.
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
};

/// The features that a device must be made with for a renderer to draw on it: what is needed, and what makes
/// it faster where it is offered.
///
///     estampe::VulkanFeatures features({.instance = instance, .physical_device = physical});
///     VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = features.chain(),
///     ...};
///
/// A host with features of its own puts them into the structures of the chain, which Vulkan allows once each:
/// VkPhysicalDeviceFeatures2, then VkPhysicalDeviceVulkan12Features, then VkPhysicalDeviceVulkan13Features.
class VulkanFeatures {
public:
    /// Asks `host.physical_device`; neither device nor queue need be there yet. Throws Error saying what the
    /// device lacks.
    explicit VulkanFeatures(const VulkanHost& host);
    VulkanFeatures(const VulkanFeatures&) = delete;
    VulkanFeatures& operator=(const VulkanFeatures&) = delete;

    /// For VkDeviceCreateInfo::pNext; lives as long as this object.
    [[nodiscard]] VkPhysicalDeviceFeatures2* chain() { return &core_; }

private:
    VkPhysicalDeviceVulkan13Features v13_{};
    VkPhysicalDeviceVulkan12Features v12_{};
    VkPhysicalDeviceFeatures2 core_{};
};

/// An image of the host's to draw into, for Renderer::render_to(): a 2D colour image of one layer and one
/// sample, of VK_FORMAT_R8G8B8A8_UNORM or _SRGB (both get the same sRGB bytes), made with
/// VK_IMAGE_USAGE_TRANSFER_DST_BIT, and as large as RenderSettings say. What it held is lost, whatever its
/// layout was. Its alpha is 1, or straight where the style's paper is transparent: blend it with
/// VK_BLEND_FACTOR_SRC_ALPHA, or multiply colours by it for a swapchain that wants them so.
struct VulkanPicture {
    VkImage image = VK_NULL_HANDLE;
    VkImageLayout layout_after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; ///< that it is left in
};

} // namespace estampe
