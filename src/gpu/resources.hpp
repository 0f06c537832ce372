// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "gpu/device.hpp"
#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// Vulkan's name for a format.
[[nodiscard]] VkFormat vulkan_format(Format format);

/// What the texels of such an image take, with all of its layers and mips; a driver may add to that.
[[nodiscard]] uint64_t size_bytes(const ImageDesc& desc);

/// A buffer in device or mapped memory. Move-only; the device must outlive it, and no frame may be in flight
/// when it dies.
class Buffer {
public:
    Buffer() = default;
    /// `size_bytes` of zero makes a 16-byte buffer, so that it can still be bound. Throws Error when memory
    /// runs out or the device cannot bind so much at once.
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

    /// The buffer as texels of `format`, for a samplerBuffer or usamplerBuffer; made when it is first asked
    /// for. Throws Error when it has more texels than the device can view at once.
    [[nodiscard]] VkBufferView texels(Format format) const;

private:
    void destroy();

    Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    mutable std::map<Format, VkBufferView> texels_;
    Allocation allocation_;
    uint64_t size_bytes_ = 0;
};

/// An image in device memory with one view over all of it (2D, or 2D array). Move-only, as Buffer.
class Image {
public:
    Image() = default;
    /// `as_array` views even a single layer as an array, as the shaders' sampler2DArray wants.
    Image(Device& device, const std::string& name, const ImageDesc& desc, bool as_array = false);

    ~Image() { destroy(); }

    Image(Image&& other) noexcept { *this = std::move(other); }

    Image& operator=(Image&& other) noexcept;
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    [[nodiscard]] VkImage handle() const { return image_; }

    [[nodiscard]] VkImageView view() const { return view_; }

    [[nodiscard]] const ImageDesc& desc() const { return desc_; }

    /// Whether the view is of an array.
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

} // namespace estampe::gpu
