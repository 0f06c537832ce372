// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "viewer/texture.hpp"

struct ImDrawData;

namespace estampe::viewer {

/// Paints what Dear ImGui lays out. Its own backend for Vulkan would link a loader beside volk's.
class UiPainter {
public:
    explicit UiPainter(Screen& screen);
    ~UiPainter();
    UiPainter(const UiPainter&) = delete;
    UiPainter& operator=(const UiPainter&) = delete;

    /// A texture that ImGui may name, see id_of(); at most 16 at a time. This must outlive it.
    [[nodiscard]] std::unique_ptr<Texture> make_texture();

    /// Makes the texture of ImGui's fonts anew, after they changed.
    void update_fonts();

    /// Before Screen::begin_drawing().
    void record_upload(VkCommandBuffer commands);
    void paint(const ImDrawData& data, VkCommandBuffer commands);

private:
    /// A buffer that grows.
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
