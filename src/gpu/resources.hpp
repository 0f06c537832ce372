// SPDX-License-Identifier: MIT
#pragma once

// Buffers and images: creation, upload and import into a graph; Vulkan's equivalents of formats, layouts and
// accesses.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <ranges>
#include <span>
#include <string>
#include <string_view>

#include "gpu/device.hpp"
#include "gpu/graph/compile.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// A buffer in device or mapped memory. Move-only. The device must outlive it, and no frame may be in flight
/// when it is destroyed.
class Buffer {
public:
    Buffer() = default;
    /// A `size_bytes` of zero makes a 16-byte buffer, which can still be bound. Throws Error if memory runs
    /// out or the buffer exceeds the device's largest binding.
    Buffer(Device& device, const std::string& name, uint64_t size_bytes, MemoryUse use);

    ~Buffer() { destroy(); }

    Buffer(Buffer&& other) noexcept { *this = std::move(other); }

    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] VkBuffer handle() const { return buffer_; }

    [[nodiscard]] uint64_t size_bytes() const { return size_bytes_; }

    [[nodiscard]] bool empty() const { return buffer_ == VK_NULL_HANDLE; }

    /// The bytes of a mapped buffer; empty for MemoryUse::device.
    [[nodiscard]] std::span<std::byte> mapped() const;

    /// View of the buffer as texels of `format`, for a samplerBuffer or usamplerBuffer; created at the first
    /// call. Throws Error if it has more texels than the device can view.
    [[nodiscard]] VkBufferView texels(Format format) const;

private:
    void destroy();

    Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    mutable std::map<Format, VkBufferView> texels_;
    Allocation allocation_;
    uint64_t size_bytes_ = 0;
};

/// An image in device memory with one view of the whole image (2D or 2D array). Move-only, as Buffer.
class Image {
public:
    Image() = default;
    /// `as_array` makes the view an array even for a single layer, as a sampler2DArray requires.
    Image(Device& device, const std::string& name, const ImageDesc& desc, bool as_array = false);

    ~Image() { destroy(); }

    Image(Image&& other) noexcept { *this = std::move(other); }

    Image& operator=(Image&& other) noexcept;
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    [[nodiscard]] VkImage handle() const { return image_; }

    [[nodiscard]] VkImageView view() const { return view_; }

    [[nodiscard]] const ImageDesc& desc() const { return desc_; }

    /// Whether the view is an array.
    [[nodiscard]] bool is_array() const { return is_array_; }

    [[nodiscard]] bool empty() const { return image_ == VK_NULL_HANDLE; }

private:
    void destroy();

    Device* device_ = nullptr;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    Allocation allocation_;
    ImageDesc desc_;
    bool is_array_ = false;
};

/// Imports all of `buffer`, which must outlive the run of `graph`.
[[nodiscard]] inline BufferId import_whole(Graph& graph, std::string_view name, Buffer& buffer)
{
    return graph.import_buffer(name, buffer, {.size_bytes = buffer.size_bytes()});
}

/// Imports all of `image`, in the layout that an upload leaves. It must outlive the run of `graph`.
[[nodiscard]] inline ImageId import_uploaded(Graph& graph, std::string_view name, Image& image)
{
    return graph.import_image(name, image, image.desc(), Layout::shader_read);
}

/// A host-visible buffer that holds `items`. Without items it has room for one item, which is not
/// initialised.
template <std::ranges::contiguous_range Items>
[[nodiscard]] Buffer mapped_buffer(Device& device, const char* name, const Items& items)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    Buffer buffer(device, name, std::max(bytes.size(), least_bytes), MemoryUse::upload);
    std::ranges::copy(bytes, buffer.mapped().begin());
    return buffer;
}

/// Copies `items` into `buffer`, which no running frame may read. Allocates a new buffer only if the size
/// differs.
template <std::ranges::contiguous_range Items>
void upload_items(Device& device, const char* name, const Items& items, Buffer& buffer)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    if (buffer.empty() || buffer.size_bytes() != std::max(bytes.size(), least_bytes)) {
        buffer = mapped_buffer(device, name, items);
        return;
    }
    std::ranges::copy(bytes, buffer.mapped().begin());
}

/// Records commands with `record`, runs them, and waits; for uploads and read-backs outside the frame.
void run_once(Device& device, const std::function<void(VkCommandBuffer)>& record);

/// A device buffer filled with `bytes`. Cost: one staging copy and one wait.
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, std::span<const std::byte> bytes);

template <class T>
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, const std::vector<T>& items)
{
    return upload_buffer(device, name, std::as_bytes(std::span(items)));
}

/// The mip levels of one image layer, finest first, each tightly packed.
struct LayerPixels {
    std::vector<std::vector<std::byte>> levels;
};

/// Fills all layers and levels of `image` and leaves it in the shader-read layout. Layers share one staging
/// buffer, so the peak of host memory is one layer.
void upload_layers(Device& device, Image& image,
                   const std::function<LayerPixels(uint32_t layer)>& layer_pixels);

struct StageAccess {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// Vulkan's pipeline stage and access mask of an access.
[[nodiscard]] StageAccess stage_access(Access access);

/// Union of the stages and accesses of a set; none for the empty set.
[[nodiscard]] StageAccess stage_access(AccessSet accesses);

[[nodiscard]] VkImageLayout vulkan_layout(Layout layout);

/// Vulkan's name for a format.
[[nodiscard]] VkFormat vulkan_format(Format format);

/// Memory of the texels of an image, with all layers and mip levels. A driver may need more.
[[nodiscard]] uint64_t size_bytes(const ImageDesc& desc);

} // namespace estampe::gpu
