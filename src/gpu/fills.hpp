// SPDX-License-Identifier: MIT
#pragma once

// Passes that fill by a command of the device, for what is small or blank: there is no shader to compile.

#include <cstdint>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "gpu/graph/graph.hpp"

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

/// A list with room for all tiles of a page, and none in it, see shaders/tile_list.glsl.h. What is not listed
/// is left as it was.
[[nodiscard]] BufferId add_empty_tile_list(Graph& graph, std::string_view name, glm::uvec2 size_px);

/// The same with room for so many words, each of which a workgroup works on, and so many zeros behind it.
[[nodiscard]] BufferId add_empty_group_list(Graph& graph, std::string_view name, uint64_t most,
                                            uint64_t zeros = 0);

} // namespace estampe::gpu
