// SPDX-License-Identifier: MIT
#pragma once

// Passes that copy what a graph has made to where it is after the run: memory that the host reads, or buffers
// of the device.

#include <span>
#include <string_view>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

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
