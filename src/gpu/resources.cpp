// SPDX-License-Identifier: MIT
#include "gpu/resources.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::gpu {

VkFormat vulkan_format(Format format)
{
    switch (format) {
    case Format::r32ui:
        return VK_FORMAT_R32_UINT;
    case Format::rg32ui:
        return VK_FORMAT_R32G32_UINT;
    case Format::rgba32ui:
        return VK_FORMAT_R32G32B32A32_UINT;
    case Format::rgba8:
        return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::r8:
        return VK_FORMAT_R8_UNORM;
    case Format::r16f:
        return VK_FORMAT_R16_SFLOAT;
    case Format::rg16f:
        return VK_FORMAT_R16G16_SFLOAT;
    case Format::rgba16f:
        return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::r32f:
        return VK_FORMAT_R32_SFLOAT;
    case Format::rgba32f:
        return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::rgba8_srgb:
        return VK_FORMAT_R8G8B8A8_SRGB;
    case Format::depth32f:
        return VK_FORMAT_D32_SFLOAT;
    }
    return VK_FORMAT_UNDEFINED;
}

namespace {

uint64_t texel_bytes(Format format)
{
    switch (format) {
    case Format::r8:
        return 1;
    case Format::r16f:
        return 2;
    case Format::r32ui:
    case Format::rgba8:
    case Format::rg16f:
    case Format::r32f:
    case Format::rgba8_srgb:
    case Format::depth32f:
        return 4;
    case Format::rg32ui:
    case Format::rgba16f:
        return 8;
    case Format::rgba32ui:
    case Format::rgba32f:
        return 16;
    }
    return 16;
}

} // namespace

uint64_t size_bytes(const ImageDesc& desc)
{
    uint64_t texels = 0;
    for (uint32_t mip = 0; mip < desc.mips; ++mip) {
        texels += uint64_t{std::max(1U, desc.width >> mip)} * std::max(1U, desc.height >> mip);
    }
    return texels * desc.layers * texel_bytes(desc.format);
}

namespace {

VkImageUsageFlags usage_for(Format format)
{
    VkImageUsageFlags usage =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (format == Format::depth32f) {
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    } else if (format != Format::rgba8_srgb) {
        usage |= VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    }
    return usage;
}

/// Mesa's software driver takes bits 8 to 15 of the size of texels for a number of mip levels, and compiles a
/// shader anew where that is zero when it was not before: here it never is.
uint64_t storage_size(uint64_t size_bytes)
{
    return (size_bytes & 0xff00U) == 0 ? size_bytes + 256 : size_bytes;
}

} // namespace

Buffer::Buffer(Device& device, const std::string& name, uint64_t size_bytes, MemoryUse use)
    : device_(&device), size_bytes_(std::max<uint64_t>(size_bytes, 16))
{
    if (use == MemoryUse::device && size_bytes_ > device.limits().maxStorageBufferRange) {
        throw Error(fmt::format("the scene needs {} MiB in one buffer, {} binds at most {}",
                                size_bytes_ >> 20, device.info().name,
                                device.limits().maxStorageBufferRange >> 20),
                    name, "use a lighter scene or another --device");
    }
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = storage_size(size_bytes_),
        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    vk_check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    try {
        allocation_ = device.memory().allocate(needs, use, false);
        vk_check(vkBindBufferMemory(device.handle(), buffer_, allocation_.memory, allocation_.offset),
                 "vkBindBufferMemory");
    } catch (...) {
        destroy();
        throw;
    }
    device.name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer_), name);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    if (this != &other) {
        destroy();
        device_ = std::exchange(other.device_, nullptr);
        buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
        texels_ = std::exchange(other.texels_, {});
        allocation_ = std::exchange(other.allocation_, {});
        size_bytes_ = std::exchange(other.size_bytes_, 0);
    }
    return *this;
}

std::span<std::byte> Buffer::mapped() const
{
    if (allocation_.mapped == nullptr) {
        return {};
    }
    return {static_cast<std::byte*>(allocation_.mapped), size_bytes_};
}

VkBufferView Buffer::texels(Format format) const
{
    VkBufferView& view = texels_[format];
    if (view != VK_NULL_HANDLE) {
        return view;
    }
    const uint64_t most = device_->limits().maxTexelBufferElements;
    if (size_bytes_ / texel_bytes(format) > most) {
        throw Error(fmt::format("the scene has a list of {} entries, {} reads at most {}",
                                size_bytes_ / texel_bytes(format), device_->info().name, most),
                    {}, "use a lighter scene or another --device");
    }
    const uint64_t count = std::min(storage_size(size_bytes_) / texel_bytes(format), most);
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = buffer_,
                                      .format = vulkan_format(format),
                                      .range = count * texel_bytes(format)};
    vk_check(vkCreateBufferView(device_->handle(), &info, nullptr, &view), "vkCreateBufferView");
    return view;
}

void Buffer::destroy()
{
    if (buffer_ != VK_NULL_HANDLE) {
        for (const auto& [format, view] : texels_) {
            vkDestroyBufferView(device_->handle(), view, nullptr);
        }
        texels_.clear();
        vkDestroyBuffer(device_->handle(), buffer_, nullptr);
        device_->memory().free(allocation_);
        buffer_ = VK_NULL_HANDLE;
    }
}

Image::Image(Device& device, const std::string& name, const ImageDesc& desc, bool as_array)
    : device_(&device), desc_(desc), is_array_(as_array || desc.layers > 1)
{
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = vulkan_format(desc.format),
                                 .extent = {desc.width, desc.height, 1},
                                 .mipLevels = desc.mips,
                                 .arrayLayers = desc.layers,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = usage_for(desc.format)};
    vk_check(vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    try {
        allocation_ = device.memory().allocate(needs, MemoryUse::device, true);
        vk_check(vkBindImageMemory(device.handle(), image_, allocation_.memory, allocation_.offset),
                 "vkBindImageMemory");
        const VkImageAspectFlags aspect =
            desc.format == Format::depth32f ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                              .image = image_,
                                              .viewType = is_array_ ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                                                    : VK_IMAGE_VIEW_TYPE_2D,
                                              .format = info.format,
                                              .subresourceRange = {aspect, 0, desc.mips, 0, desc.layers}};
        vk_check(vkCreateImageView(device.handle(), &view_info, nullptr, &view_), "vkCreateImageView");
    } catch (...) {
        destroy();
        throw;
    }
    device.name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image_), name);
}

Image& Image::operator=(Image&& other) noexcept
{
    if (this != &other) {
        destroy();
        device_ = std::exchange(other.device_, nullptr);
        image_ = std::exchange(other.image_, VK_NULL_HANDLE);
        view_ = std::exchange(other.view_, VK_NULL_HANDLE);
        allocation_ = std::exchange(other.allocation_, {});
        desc_ = other.desc_;
        is_array_ = other.is_array_;
    }
    return *this;
}

void Image::destroy()
{
    if (image_ != VK_NULL_HANDLE) {
        vkDestroyImageView(device_->handle(), view_, nullptr);
        vkDestroyImage(device_->handle(), image_, nullptr);
        device_->memory().free(allocation_);
        image_ = VK_NULL_HANDLE;
    }
}

} // namespace estampe::gpu
