// SPDX-License-Identifier: MIT
#pragma once

// What all ways to look at discs begin and end with.

#include "techniques/occlusion/discs/discs.hpp"

namespace estampe::occlusion {

/// The tree's levels, and what the style asks of them.
[[nodiscard]] shared::DiscConstants constants_of(uint32_t disc_count, const DiscSettings& settings);

/// Places the discs on posed vertices, and takes them together level by level. Returns the tree.
[[nodiscard]] gpu::BufferId add_disc_tree(gpu::Graph& graph, DiscBuffers& buffers,
                                          gpu::BufferId posed_vertices, shared::DiscConstants constants);

/// Binds what a pass over pixels writes, and says so in its variant.
[[nodiscard]] OpenPage write_page(gpu::Graph& graph, gpu::Pass& pass, glm::uvec2 size_px, bool throws);

} // namespace estampe::occlusion
