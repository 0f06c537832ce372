// SPDX-License-Identifier: MIT
#pragma once

// Passes that are commands of the device, without a shader: fills, copies, and what the host reads after the
// run.

#include <cstdint>
#include <span>
#include <string_view>

#include <glm/glm.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

/// A new image that is `color` everywhere; of whole numbers, all bits 0 are the only ones to ask for. Cost: a
/// GPU fills a page quicker by threads.
[[nodiscard]] ImageId add_filled_image(Graph& graph, std::string_view name, const ImageDesc& desc,
                                       const glm::vec4& color);

/// The same of an image that is there already, all layers of it.
[[nodiscard]] ImageId add_fill(Graph& graph, std::string_view name, ImageId image, const glm::vec4& color);

/// A new buffer of zeros, of at least 16 bytes.
[[nodiscard]] BufferId add_zeros(Graph& graph, std::string_view name, uint64_t size_bytes);

/// The same behind the arguments of a dispatch of no workgroups: 0, 1, 1.
[[nodiscard]] BufferId add_empty_list(Graph& graph, std::string_view name, uint64_t size_bytes);

/// A list with room for all tiles of a page, and none in it, see shaders/tiles.glsl.h. What is not listed
/// is left as it was.
[[nodiscard]] BufferId add_empty_tile_list(Graph& graph, std::string_view name, glm::uvec2 size_px);

/// The same with room for so many words, each of which a workgroup works on, and so many zeros behind it.
[[nodiscard]] BufferId add_empty_group_list(Graph& graph, std::string_view name, uint64_t most,
                                            uint64_t zeros = 0);

/// Copies `from` to the start of `to`, which is at least as large, of MemoryUse::readback, and outlives the
/// run of `graph`.
void add_read_back(Graph& graph, std::string_view name, BufferId from, Buffer& to);

/// The same of an image, its first layer and mip, row by row without gaps.
void add_read_back(Graph& graph, std::string_view name, ImageId from, Buffer& to);

/// The host reads `written`, an imported buffer of MemoryUse::readback, after the run.
void add_host_read(Graph& graph, std::string_view name, BufferId written);

/// Copies the start of `from`, as much as `to` holds, for graphs that run later; `to` is no larger, and
/// outlives the run of `graph`. Returns the copy.
BufferId add_copy_out(Graph& graph, std::string_view name, BufferId from, Buffer& to);

/// A new buffer of the device's own memory with the first `size_bytes` of `from`.
[[nodiscard]] BufferId add_copy_of_start(Graph& graph, std::string_view name, BufferId from,
                                         uint64_t size_bytes);

/// What lies in a buffer of mapped memory, from an offset on.
template <class T>
[[nodiscard]] std::span<const T> items_of(const Buffer& buffer, uint64_t offset_bytes = 0)
{
    const auto bytes = buffer.mapped().subspan(offset_bytes);
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// Copies `pixels`, four bytes each, into an image of the host application's, which no graph knows of: its
/// layout is changed here.
void add_hand_over(Graph& graph, BufferId pixels, const VulkanPicture& picture, glm::uvec2 size_px);

} // namespace estampe::gpu
