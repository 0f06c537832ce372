// SPDX-License-Identifier: MIT
#include "gpu/fills.hpp"

#include <glm/vec4.hpp>

#include "gpu/graph/execute.hpp"
#include "shaders/tile_list.glsl.h"

namespace estampe::gpu {
namespace {

/// Four words, and zeros from a place on. Each command has a GPU to itself.
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

} // namespace estampe::gpu
