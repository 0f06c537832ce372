// SPDX-License-Identifier: MIT
#include "viewer/texture.hpp"

#include <cstring>

namespace estampe::viewer {
namespace {

using gpu::vk_check;

VkImageMemoryBarrier2 barrier_of(VkImage image)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
}

} // namespace

Texture::Texture(Screen& screen, VkDescriptorPool pool, VkDescriptorSetLayout layout, VkSampler sampler)
    : screen_(screen), pool_(pool), sampler_(sampler)
{
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    vk_check(screen_.vk().AllocateDescriptorSets(screen_.device(), &info, &descriptor_),
             "vkAllocateDescriptorSets");
}

Texture::~Texture()
{
    screen_.vk().DeviceWaitIdle(screen_.device());
    destroy();
    screen_.vk().FreeDescriptorSets(screen_.device(), pool_, 1, &descriptor_);
}

void Texture::destroy()
{
    const DeviceFunctions& vk = screen_.vk();
    vk.DestroyImageView(screen_.device(), view_, nullptr);
    vk.DestroyImage(screen_.device(), image_, nullptr);
    vk.FreeMemory(screen_.device(), image_memory_.memory, nullptr);
    vk.DestroyBuffer(screen_.device(), staging_, nullptr);
    vk.FreeMemory(screen_.device(), staging_memory_.memory, nullptr);
    image_ = VK_NULL_HANDLE;
    view_ = VK_NULL_HANDLE;
    staging_ = VK_NULL_HANDLE;
    image_memory_ = {};
    staging_memory_ = {};
}

void Texture::create(uint32_t width, uint32_t height)
{
    const DeviceFunctions& vk = screen_.vk();
    destroy();
    width_ = width;
    height_ = height;
    const VkBufferCreateInfo buffer_info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                         .size = VkDeviceSize{4} * width * height,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    vk_check(vk.CreateBuffer(screen_.device(), &buffer_info, nullptr, &staging_), "vkCreateBuffer");
    staging_memory_ = screen_.allocate(staging_);
    const VkImageCreateInfo image_info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                       .imageType = VK_IMAGE_TYPE_2D,
                                       .format = VK_FORMAT_R8G8B8A8_UNORM,
                                       .extent = {width, height, 1},
                                       .mipLevels = 1,
                                       .arrayLayers = 1,
                                       .samples = VK_SAMPLE_COUNT_1_BIT,
                                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    vk_check(vk.CreateImage(screen_.device(), &image_info, nullptr, &image_), "vkCreateImage");
    image_memory_ = screen_.allocate(image_);
    const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                          .image = image_,
                                          .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                          .format = image_info.format,
                                          .subresourceRange = barrier_of(image_).subresourceRange};
    vk_check(vk.CreateImageView(screen_.device(), &view_info, nullptr, &view_), "vkCreateImageView");
    const VkDescriptorImageInfo sampled{
        .sampler = sampler_, .imageView = view_, .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = descriptor_,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &sampled};
    vk.UpdateDescriptorSets(screen_.device(), 1, &write, 0, nullptr);
}

void Texture::set(uint32_t width, uint32_t height, std::span<const uint8_t> rgba)
{
    screen_.wait();
    if (width != width_ || height != height_) {
        create(width, height);
    }
    std::memcpy(staging_memory_.mapped, rgba.data(), rgba.size());
    is_new_ = true;
}

void Texture::record_upload(VkCommandBuffer commands)
{
    if (!is_new_) {
        return;
    }
    is_new_ = false;
    const DeviceFunctions& vk = screen_.vk();
    VkImageMemoryBarrier2 barrier = barrier_of(image_);
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &barrier};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    vk.CmdPipelineBarrier2(commands, &dependency);
    const VkBufferImageCopy region{
        .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
        .imageExtent = {width_, height_, 1}};
    vk.CmdCopyBufferToImage(commands, staging_, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    vk.CmdPipelineBarrier2(commands, &dependency);
}

} // namespace estampe::viewer
