// SPDX-License-Identifier: MIT
#include "gpu/resources.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::gpu {

StageAccess stage_access(Access access)
{
    constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 raster =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    switch (access) {
    case Access::compute_sampled:
        return {compute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Access::compute_storage_read:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Access::compute_storage_write:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Access::compute_storage_modify:
        return {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    case Access::compute_uniform:
        return {compute, VK_ACCESS_2_UNIFORM_READ_BIT};
    case Access::raster_sampled:
        return {raster, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    case Access::raster_storage_read:
        return {raster, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    case Access::raster_uniform:
        return {raster, VK_ACCESS_2_UNIFORM_READ_BIT};
    case Access::indirect:
        return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
    case Access::transfer_read:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    case Access::transfer_write:
        return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    case Access::color_attachment:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Access::color_attachment_modify:
        return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case Access::depth_attachment:
        return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    case Access::host_read:
        return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    }
    return {};
}

StageAccess stage_access(AccessSet accesses)
{
    StageAccess all;
    accesses.for_each([&](Access access) {
        all.stage |= stage_access(access).stage;
        all.access |= stage_access(access).access;
    });
    return all;
}

VkImageLayout vulkan_layout(Layout layout)
{
    switch (layout) {
    case Layout::undefined:
        return VK_IMAGE_LAYOUT_UNDEFINED;
    case Layout::general:
        return VK_IMAGE_LAYOUT_GENERAL;
    case Layout::shader_read:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case Layout::transfer_source:
        return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    case Layout::transfer_target:
        return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    case Layout::color:
        return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case Layout::depth:
        return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    }
    return VK_IMAGE_LAYOUT_UNDEFINED;
}

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

/// Returns a buffer size, at least `size_bytes`, in which bits 8 to 15 are never zero. Mesa's software driver
/// misreads bits 8 to 15 of a texel buffer's size as a number of mip levels. The driver recompiles a shader
/// when the misread bits change between zero and non-zero.
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

namespace {

void change_layout(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier2 barrier{
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
        .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .image = image.handle(),
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, image.desc().mips, 0, image.desc().layers}};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

void copy_layer(Device& device, Image& image, uint32_t layer, const LayerPixels& pixels)
{
    size_t total = 0;
    for (const auto& level : pixels.levels) {
        total += level.size();
    }
    const Buffer staging(device, "staging", total, MemoryUse::upload);
    std::vector<VkBufferImageCopy> regions;
    size_t offset = 0;
    for (uint32_t level = 0; level < pixels.levels.size(); ++level) {
        std::memcpy(staging.mapped().data() + offset, pixels.levels[level].data(),
                    pixels.levels[level].size());
        regions.push_back({.bufferOffset = offset,
                           .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, layer, 1},
                           .imageExtent = {std::max(1U, image.desc().width >> level),
                                           std::max(1U, image.desc().height >> level), 1}});
        offset += pixels.levels[level].size();
    }
    run_once(device, [&](VkCommandBuffer commands) {
        vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, static_cast<uint32_t>(regions.size()),
                               regions.data());
    });
}

} // namespace

void run_once(Device& device, const std::function<void(VkCommandBuffer)>& record)
{
    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                            .queueFamilyIndex = device.queue_family()};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateCommandPool(device.handle(), &pool_info, nullptr, &pool), "vkCreateCommandPool");
    try {
        const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
        VkCommandBuffer commands = VK_NULL_HANDLE;
        vk_check(vkAllocateCommandBuffers(device.handle(), &info, &commands), "vkAllocateCommandBuffers");
        const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                             .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
        vk_check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
        record(commands);
        vk_check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        device.submit_and_wait(commands);
    } catch (...) {
        vkDestroyCommandPool(device.handle(), pool, nullptr);
        throw;
    }
    vkDestroyCommandPool(device.handle(), pool, nullptr);
}

Buffer upload_buffer(Device& device, const std::string& name, std::span<const std::byte> bytes)
{
    Buffer buffer(device, name, bytes.size(), MemoryUse::device);
    if (bytes.empty()) {
        return buffer;
    }
    const Buffer staging(device, name + " staging", bytes.size(), MemoryUse::upload);
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    run_once(device, [&](VkCommandBuffer commands) {
        const VkBufferCopy region{.size = bytes.size()};
        vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &region);
    });
    return buffer;
}

void upload_layers(Device& device, Image& image,
                   const std::function<LayerPixels(uint32_t layer)>& layer_pixels)
{
    run_once(device, [&](VkCommandBuffer commands) {
        change_layout(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    });
    for (uint32_t layer = 0; layer < image.desc().layers; ++layer) {
        copy_layer(device, image, layer, layer_pixels(layer));
    }
    run_once(device, [&](VkCommandBuffer commands) {
        change_layout(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
}

} // namespace estampe::gpu
