// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "viewer/screen.hpp"

namespace estampe::viewer {

/// A picture that is painted on the screen, of four bytes a pixel; it grows with what it is given.
class Texture {
public:
    /// Of descriptor sets that UiPainter allots.
    Texture(Screen& screen, VkDescriptorPool pool, VkDescriptorSetLayout layout, VkSampler sampler);
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    /// From the next frame on it is this. Cost: a copy.
    void set(uint32_t width, uint32_t height, std::span<const uint8_t> rgba);

    /// Copies what was set to the device, if it is new. To be called between Screen::begin() and
    /// begin_drawing().
    void record_upload(VkCommandBuffer commands);

    [[nodiscard]] bool empty() const { return width_ == 0; }

    [[nodiscard]] uint32_t width() const { return width_; }

    [[nodiscard]] uint32_t height() const { return height_; }

    [[nodiscard]] VkDescriptorSet descriptor() const { return descriptor_; }

private:
    void destroy();
    void create(uint32_t width, uint32_t height);

    Screen& screen_;
    VkDescriptorPool pool_;
    VkSampler sampler_;
    VkDescriptorSet descriptor_ = VK_NULL_HANDLE;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    Allocation image_memory_;
    VkBuffer staging_ = VK_NULL_HANDLE;
    Allocation staging_memory_;
    uint32_t width_ = 0;
    uint32_t height_ = 0;
    bool is_new_ = false;
};

} // namespace estampe::viewer
