// SPDX-License-Identifier: MIT
#pragma once

// From coordinates of corners to coordinates of vertices.

#include <span>
#include <vector>

#include "techniques/form/form.hpp"

namespace estampe::form {

struct SplitMesh {
    std::vector<uint32_t>
        indices; ///< into the vertices below; as many triangles as before, in the same order
    std::vector<uint32_t> sources; ///< one a vertex: the vertex that it is a copy of; the old ones come first
    std::vector<glm::vec2> coordinates; ///< one a vertex: (a, b)
};

/// Copies each vertex whose corners have different coordinates, once for every other pair of them, so that
/// coordinates can be an attribute of vertices. Indices past `vertex_count` are an error of the caller. Cost:
/// linear.
[[nodiscard]] SplitMesh split_at_jumps(std::span<const uint32_t> triangle_indices, uint32_t vertex_count,
                                       const FormField& field);

} // namespace estampe::form
