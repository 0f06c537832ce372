// SPDX-License-Identifier: MIT
#include "gpu/upload.hpp"

#include <algorithm>
#include <cstring>

namespace estampe::gpu {
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
