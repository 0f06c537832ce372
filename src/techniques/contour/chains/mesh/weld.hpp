// SPDX-License-Identifier: MIT
#pragma once

// Which vertices lie at one place: the first step to which triangles are neighbours.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::contour {

/// The vertices to weld, as TriangleSoup has them.
struct WeldInput {
    std::span<const glm::uvec4> triangles;
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> mesh_positions;
    std::span<const uint32_t> bodies;         ///< one per triangle
    std::span<const uint32_t> body_of_vertex; ///< no_side: the vertex has no lines
};

/// The first vertex at the place of each vertex, or no_side for those without lines. Within one body only,
/// by `weld_tolerance`. Cost: linear; about 0.2 us per vertex.
[[nodiscard]] std::vector<uint32_t> weld_vertices(const WeldInput& input);

} // namespace estampe::contour
