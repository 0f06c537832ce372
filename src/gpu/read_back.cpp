// SPDX-License-Identifier: MIT
#include "gpu/read_back.hpp"

#include <estampe/vulkan.hpp>

#include "gpu/graph/execute.hpp"
#include "gpu/imports.hpp"

namespace estampe::gpu {
namespace {

/// `copy` is called with the recorder and the handle of `to`.
template <class Id, class Copy>
void add_copy(Graph& graph, std::string_view name, Id from, Buffer& to, const Copy& copy)
{
    auto pass = graph.custom(name);
    pass.touch(from, Access::transfer_read);
    const BufferId copied = pass.touch_write(import_whole(graph, name, to), Access::transfer_write);
    pass.execute([=](Recorder& recorder) { copy(recorder, recorder.buffer(copied).handle()); });
    add_host_read(graph, Name(name) + "/host", copied);
}

void change_layout(VkCommandBuffer commands, const VkImageMemoryBarrier2& change)
{
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .imageMemoryBarrierCount = 1,
                                      .pImageMemoryBarriers = &change};
    vkCmdPipelineBarrier2(commands, &dependency);
}

/// Returns the version of `to` whose start has been overwritten.
BufferId add_copy_between(Graph& graph, std::string_view name, BufferId from, BufferId to,
                          uint64_t size_bytes)
{
    auto pass = graph.custom(name);
    pass.touch(from, Access::transfer_read);
    const BufferId copied = pass.touch_write(to, Access::transfer_write);
    pass.execute([=](Recorder& recorder) {
        const VkBufferCopy region{.size = size_bytes};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(from).handle(), recorder.buffer(copied).handle(),
                        1, &region);
    });
    return copied;
}

} // namespace

void add_hand_over(Graph& graph, BufferId pixels, const VulkanPicture& picture, glm::uvec2 size_px)
{
    auto pass = graph.custom("hand over");
    pass.touch(pixels, Access::transfer_read);
    pass.keep();
    pass.execute([=](Recorder& recorder) {
        VkImageMemoryBarrier2 change{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                     .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                     .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                     .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                     .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                     .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
                                     .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                     .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                     .image = picture.image,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        change_layout(recorder.commands(), change);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {size_px.x, size_px.y, 1}};
        vkCmdCopyBufferToImage(recorder.commands(), recorder.buffer(pixels).handle(), picture.image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        change.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        change.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        change.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        change.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT;
        change.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        change.newLayout = picture.layout_after;
        change_layout(recorder.commands(), change);
    });
}

void add_host_read(Graph& graph, std::string_view name, BufferId written)
{
    graph.custom(name).touch(written, Access::host_read).keep();
}

void add_read_back(Graph& graph, std::string_view name, BufferId from, Buffer& to)
{
    const uint64_t size_bytes = graph.describe(from).size_bytes;
    add_copy(graph, name, from, to, [=](Recorder& recorder, VkBuffer target) {
        const VkBufferCopy region{.size = size_bytes};
        vkCmdCopyBuffer(recorder.commands(), recorder.buffer(from).handle(), target, 1, &region);
    });
}

void add_read_back(Graph& graph, std::string_view name, ImageId from, Buffer& to)
{
    const ImageDesc desc = graph.describe(from);
    add_copy(graph, name, from, to, [=](Recorder& recorder, VkBuffer target) {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {desc.width, desc.height, 1}};
        vkCmdCopyImageToBuffer(recorder.commands(), recorder.image(from).handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, 1, &region);
    });
}

BufferId add_copy_out(Graph& graph, std::string_view name, BufferId from, Buffer& to)
{
    return add_copy_between(graph, name, from, import_whole(graph, name, to), to.size_bytes());
}

BufferId add_copy_of_start(Graph& graph, std::string_view name, BufferId from, uint64_t size_bytes)
{
    return add_copy_between(graph, name, from, graph.buffer(name, {.size_bytes = size_bytes}), size_bytes);
}

} // namespace estampe::gpu
