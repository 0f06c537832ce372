// SPDX-License-Identifier: MIT
#pragma once

// Welding: merging vertices of a mesh that lie at the same position.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::contour {

/// Input of the welding (merging vertices at the same position). The members of WeldInput have the meaning of
/// the members of TriangleSoup.
struct WeldInput {
    std::span<const glm::uvec4> triangles;
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> mesh_positions;
    /// Number of the body (connected part of one node) to which each triangle belongs.
    std::span<const uint32_t> bodies;
    /// Number of the body to which each vertex belongs; no_side if the vertex has no lines.
    std::span<const uint32_t> body_of_vertex;
};

/// Returns for each vertex the first vertex at the same position, or no_side if the vertex has no lines.
/// Welds only vertices of one body, within `weld_tolerance`. Cost: linear; about 0.2 us per vertex.
[[nodiscard]] std::vector<uint32_t> weld_vertices(const WeldInput& input);

} // namespace estampe::contour
