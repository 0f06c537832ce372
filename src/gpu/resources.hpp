// SPDX-License-Identifier: MIT
#pragma once

// Creates buffers and images, uploads their content and imports them into a frame graph. Converts formats,
// layouts and accesses to Vulkan's values.

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

/// A buffer in device or mapped memory. Move-only. The device must outlive the buffer, and no frame may be in
/// flight when the buffer is destroyed.
class Buffer {
public:
    Buffer() = default;
    /// Creates a buffer. A `size_bytes` of zero creates a 16-byte buffer, which can still be bound. Throws
    /// Error if memory runs out, or if the buffer is larger than the device can bind.
    Buffer(Device& device, const std::string& name, uint64_t size_bytes, MemoryUse use);

    ~Buffer() { destroy(); }

    Buffer(Buffer&& other) noexcept { *this = std::move(other); }

    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] VkBuffer handle() const { return buffer_; }

    [[nodiscard]] uint64_t size_bytes() const { return size_bytes_; }

    [[nodiscard]] bool empty() const { return buffer_ == VK_NULL_HANDLE; }

    /// The mapped bytes of the buffer; empty if its memory is MemoryUse::device, which is not mapped.
    [[nodiscard]] std::span<std::byte> mapped() const;

    /// Returns a view of the buffer as texels of `format`, for a samplerBuffer or usamplerBuffer. The first
    /// call for each format creates the view. Throws Error if the buffer has more texels than the device can
    /// view.
    [[nodiscard]] VkBufferView texels(Format format) const;

private:
    void destroy();

    Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    mutable std::map<Format, VkBufferView> texels_;
    Allocation allocation_;
    uint64_t size_bytes_ = 0;
};

/// An image in device memory, with one view of the whole image (2D or 2D array). Move-only. The device must
/// outlive the image.
class Image {
public:
    Image() = default;
    /// Creates an image. `as_array` makes its view a 2D array even if it has a single layer, because a
    /// sampler2DArray requires an array view.
    Image(Device& device, const std::string& name, const ImageDesc& desc, bool as_array = false);

    ~Image() { destroy(); }

    Image(Image&& other) noexcept { *this = std::move(other); }

    Image& operator=(Image&& other) noexcept;
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    [[nodiscard]] VkImage handle() const { return image_; }

    [[nodiscard]] VkImageView view() const { return view_; }

    [[nodiscard]] const ImageDesc& desc() const { return desc_; }

    /// Whether the image view is a 2D array view.
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

/// Imports the whole of `buffer`, which must outlive the run of `graph`.
[[nodiscard]] inline BufferId import_whole(Graph& graph, std::string_view name, Buffer& buffer)
{
    return graph.import_buffer(name, buffer, {.size_bytes = buffer.size_bytes()});
}

/// Imports the whole of `image`. The image must be in the layout that upload_layers() leaves, and must
/// outlive the run of `graph`.
[[nodiscard]] inline ImageId import_uploaded(Graph& graph, std::string_view name, Image& image)
{
    return graph.import_image(name, image, image.desc(), Layout::shader_read);
}

/// Creates a host-visible buffer that holds `items`. If `items` is empty, the buffer has room for one item,
/// which is not initialised.
template <std::ranges::contiguous_range Items>
[[nodiscard]] Buffer mapped_buffer(Device& device, const char* name, const Items& items)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    Buffer buffer(device, name, std::max(bytes.size(), least_bytes), MemoryUse::upload);
    std::ranges::copy(bytes, buffer.mapped().begin());
    return buffer;
}

/// Copies `items` into `buffer`. No running frame may read `buffer`. A new buffer is allocated only if the
/// size differs.
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

/// Records commands with `record`, runs the commands, and waits until they finish. Used for uploads and
/// read-backs outside the frame.
void run_once(Device& device, const std::function<void(VkCommandBuffer)>& record);

/// Creates a device buffer that holds `bytes`. Cost: one staging copy and one wait for the device.
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, std::span<const std::byte> bytes);

template <class T>
[[nodiscard]] Buffer upload_buffer(Device& device, const std::string& name, const std::vector<T>& items)
{
    return upload_buffer(device, name, std::as_bytes(std::span(items)));
}

/// The texels of one image layer: one array of tightly packed bytes per mip level, finest level first.
struct LayerPixels {
    std::vector<std::vector<std::byte>> levels;
};

/// Fills all layers and mip levels of `image`, and leaves the image in the shader-read layout. All layers
/// share one staging buffer, so the peak host memory is the size of one layer.
void upload_layers(Device& device, Image& image,
                   const std::function<LayerPixels(uint32_t layer)>& layer_pixels);

struct StageAccess {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// Returns Vulkan's pipeline stage and access mask for `access`.
[[nodiscard]] StageAccess stage_access(Access access);

/// Returns the union of the pipeline stages and access masks for a set of accesses; zero for the empty set.
[[nodiscard]] StageAccess stage_access(AccessSet accesses);

[[nodiscard]] VkImageLayout vulkan_layout(Layout layout);

/// Returns Vulkan's equivalent of `format`.
[[nodiscard]] VkFormat vulkan_format(Format format);

/// Returns the size of an image's texels, including all layers and mip levels. A driver may need more memory
/// than this size.
[[nodiscard]] uint64_t size_bytes(const ImageDesc& desc);

} // namespace estampe::gpu
