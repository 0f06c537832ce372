// SPDX-License-Identifier: MIT
#include "gpu/transfers.hpp"

#include <glm/vec4.hpp>

#include <estampe/vulkan.hpp>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "shaders/tiles.glsl.h"

namespace estampe::gpu {
namespace {

/// Adds a new buffer of zeros. If `zeros_from` is not 0, the buffer begins with `words`, and the zeros begin
/// at `zeros_from`. A GPU runs the commands that write the words and the zeros one after the other.
BufferId add_words(Graph& graph, std::string_view name, uint64_t size_bytes, const glm::uvec4& words,
                   uint64_t zeros_from)
{
    auto pass = graph.custom(name);
    const BufferId filled =
        pass.touch_write(graph.buffer(name, {.size_bytes = size_bytes}), Access::transfer_write);
    pass.execute([=](Recorder& recorder) {
        const VkBuffer buffer = recorder.buffer(filled).handle();
        if (zeros_from > 0) {
            vkCmdUpdateBuffer(recorder.commands(), buffer, 0, sizeof(words), &words);
        }
        if (zeros_from < size_bytes) {
            vkCmdFillBuffer(recorder.commands(), buffer, zeros_from, size_bytes - zeros_from, 0);
        }
    });
    return filled;
}

} // namespace

ImageId add_filled_image(Graph& graph, std::string_view name, const ImageDesc& desc, const glm::vec4& color)
{
    return add_fill(graph, name, graph.image(name, desc), color);
}

ImageId add_fill(Graph& graph, std::string_view name, ImageId image, const glm::vec4& color)
{
    auto pass = graph.custom(name);
    const ImageId filled = pass.touch_write(image, Access::transfer_write);
    pass.execute([filled, color](Recorder& recorder) {
        const VkClearColorValue value{.float32 = {color.x, color.y, color.z, color.w}};
        const VkImageSubresourceRange whole{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                            .levelCount = 1,
                                            .layerCount = VK_REMAINING_ARRAY_LAYERS};
        vkCmdClearColorImage(recorder.commands(), recorder.image(filled).handle(),
                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &whole);
    });
    return filled;
}

BufferId add_zeros(Graph& graph, std::string_view name, uint64_t size_bytes)
{
    return add_words(graph, name, size_bytes, glm::uvec4(0), 0);
}

BufferId add_empty_list(Graph& graph, std::string_view name, uint64_t size_bytes)
{
    return add_words(graph, name, size_bytes, {0, 1, 1, 0}, sizeof(glm::uvec4));
}

BufferId add_empty_tile_list(Graph& graph, std::string_view name, glm::uvec2 size_px)
{
    const glm::uvec2 tiles = (size_px + 7U) / 8U;
    return add_empty_group_list(graph, name, uint64_t{tiles.x} * tiles.y);
}

BufferId add_empty_group_list(Graph& graph, std::string_view name, uint64_t most, uint64_t zeros)
{
    const uint64_t listed = shared::tile_list_first + most;
    const uint64_t size_bytes = (sizeof(uint32_t) * (listed + zeros) + 15) / 16 * 16;
    return add_words(graph, name, size_bytes, {shared::tile_list_groups, 0, 1, 0},
                     zeros > 0 ? sizeof(uint32_t) * listed : size_bytes);
}

namespace {

/// Adds a pass that copies `from` to `to`. The pass calls `copy` with the recorder and the graph's handle of
/// `to`.
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

/// Copies the first `size_bytes` of `from` over the start of `to`. Returns the new version of `to`.
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
