// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <imgui.h>

#include "viewer/screen.hpp"

namespace estampe::viewer {

/// A texture that ImGui paints on the screen, four bytes per pixel; it grows as needed.
class Texture {
public:
    /// Creates an empty texture, whose descriptor set is allocated from UiPainter's pool.
    Texture(Screen& screen, VkDescriptorPool pool, VkDescriptorSetLayout layout, VkSampler sampler);
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    /// Replaces the texture's content from the next frame on. The pixels are copied.
    void set(uint32_t width, uint32_t height, std::span<const uint8_t> rgba);

    /// Copies new content of the texture to the device. Call this between Screen::begin() and
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

/// Returns ImGui's identifier of a texture: a pointer in ImGui's versions up to 1.91, a number later.
[[nodiscard]] inline ImTextureID id_of(const Texture& texture)
{
    static_assert(sizeof(ImTextureID) == sizeof(VkDescriptorSet));
    return std::bit_cast<ImTextureID>(texture.descriptor());
}

[[nodiscard]] inline VkDescriptorSet descriptor_of(ImTextureID id)
{
    return std::bit_cast<VkDescriptorSet>(id);
}

/// Paints the panels: the triangles that Dear ImGui returns as draw data. ImGui's own Vulkan backend would
/// link a loader in addition to volk's.
class UiPainter {
public:
    explicit UiPainter(Screen& screen);
    ~UiPainter();
    UiPainter(const UiPainter&) = delete;
    UiPainter& operator=(const UiPainter&) = delete;

    /// Makes a texture for use in ImGui, see id_of(); at most 16 at a time. The UiPainter must outlive the
    /// texture.
    [[nodiscard]] std::unique_ptr<Texture> make_texture();

    /// Rebuilds ImGui's font texture after the fonts changed.
    void update_fonts();

    /// Copies changed textures to the device. Call this before Screen::begin_drawing().
    void record_upload(VkCommandBuffer commands);
    void paint(const ImDrawData& data, VkCommandBuffer commands);

private:
    /// A buffer in host-visible memory that grows as needed.
    struct Mapped {
        VkBuffer buffer = VK_NULL_HANDLE;
        Allocation memory;
        VkDeviceSize size_bytes = 0;
    };

    void create_layout();
    void create_pipeline();
    void ensure(Mapped& mapped, VkDeviceSize size_bytes, VkBufferUsageFlags usage);
    void destroy(Mapped& mapped);
    void copy_geometry(const ImDrawData& data);

    Screen& screen_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Mapped vertices_;
    Mapped indices_;
    std::unique_ptr<Texture> fonts_;
};

} // namespace estampe::viewer
