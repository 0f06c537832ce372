// SPDX-License-Identifier: MIT
#pragma once

// The Vulkan objects that a host application already has: a device, and an image on the device.

#include <cstdint>
#include <vector>

#include <estampe/vulkan.hpp>

/// An instance, a device that Estampe can draw on, and one queue. The constructor throws std::runtime_error.
class Host {
public:
    Host();
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    [[nodiscard]] const estampe::VulkanHost& vulkan() const { return vulkan_; }

    /// Allocates memory for a buffer or an image, of a type with these properties.
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs,
                                          VkMemoryPropertyFlags wanted) const;

private:
    estampe::VulkanHost vulkan_;
};

/// An image that the host's shaders could sample.
class Texture {
public:
    Texture(const Host& host, uint32_t width, uint32_t height);
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    [[nodiscard]] VkImage image() const { return image_; }

    /// The image's texels, four bytes each, row by row. The image must be in
    /// VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL.
    [[nodiscard]] std::vector<uint8_t> read() const;

private:
    const Host& host_;
    uint32_t width_;
    uint32_t height_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
};
