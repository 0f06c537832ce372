// SPDX-License-Identifier: MIT
#pragma once

// Adds passes that need no shader: fills, copies, and read-backs to the host.

#include <cstdint>
#include <span>
#include <string_view>

#include <glm/glm.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

/// Adds a new image that is filled with `color`. Integer images can only be filled with zero bits. A GPU
/// fills an image of page size faster with a compute pass.
[[nodiscard]] ImageId add_filled_image(Graph& graph, std::string_view name, const ImageDesc& desc,
                                       const glm::vec4& color);

/// Fills all layers of an existing image with `color`.
[[nodiscard]] ImageId add_fill(Graph& graph, std::string_view name, ImageId image, const glm::vec4& color);

/// Adds a new buffer of zeros, at least 16 bytes long.
[[nodiscard]] BufferId add_zeros(Graph& graph, std::string_view name, uint64_t size_bytes);

/// Adds a new buffer that holds an empty list: dispatch arguments for zero workgroups (0, 1, 1), followed by
/// zeros.
[[nodiscard]] BufferId add_empty_list(Graph& graph, std::string_view name, uint64_t size_bytes);

/// Adds a buffer that holds an empty list of screen tiles, with room for all tiles of a page; see
/// shaders/tiles.glsl.h. The entries are not initialised.
[[nodiscard]] BufferId add_empty_tile_list(Graph& graph, std::string_view name, glm::uvec2 size_px);

/// Adds a buffer that holds an empty list with room for `most` entries, each processed by one workgroup.
/// `zeros` words of zero follow the list.
[[nodiscard]] BufferId add_empty_group_list(Graph& graph, std::string_view name, uint64_t most,
                                            uint64_t zeros = 0);

/// Copies `from` to the start of `to`, a buffer of MemoryUse::readback that is at least as large and
/// outlives the run of `graph`.
void add_read_back(Graph& graph, std::string_view name, BufferId from, Buffer& to);

/// Copies the first layer and mip level of `from` to `to`, row by row without gaps. `to` is a buffer of
/// MemoryUse::readback that is large enough and outlives the run of `graph`.
void add_read_back(Graph& graph, std::string_view name, ImageId from, Buffer& to);

/// Declares that the host reads `written` after the run. `written` must be an imported buffer of
/// MemoryUse::readback.
void add_host_read(Graph& graph, std::string_view name, BufferId written);

/// Fills `to` from the start of `from`, so that graphs that run later can use the content. `to` must be no
/// larger than `from` and must outlive the run of `graph`. Returns the handle of the copy.
BufferId add_copy_out(Graph& graph, std::string_view name, BufferId from, Buffer& to);

/// Adds a new buffer in device memory that holds a copy of the first `size_bytes` of `from`.
[[nodiscard]] BufferId add_copy_of_start(Graph& graph, std::string_view name, BufferId from,
                                         uint64_t size_bytes);

/// Returns the items in a mapped buffer, starting at `offset_bytes`.
template <class T>
[[nodiscard]] std::span<const T> items_of(const Buffer& buffer, uint64_t offset_bytes = 0)
{
    const auto bytes = buffer.mapped().subspan(offset_bytes);
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// Copies `pixels`, four bytes per pixel, into an image of the host application. The image is not a resource
/// of the graph, so this pass changes the image's layout itself.
void add_hand_over(Graph& graph, BufferId pixels, const VulkanPicture& picture, glm::uvec2 size_px);

} // namespace estampe::gpu
