// SPDX-License-Identifier: MIT
#pragma once

// What the procedural shapes share.

#include <cstdint>
#include <numbers>

#include <estampe/scene.hpp>

namespace estampe::shapes {

inline constexpr float turn_rad = 2.0F * std::numbers::pi_v<float>;

/// Adds a vertex and returns its index.
inline uint32_t add_vertex(Primitive& mesh, const glm::vec3& position, const glm::vec3& normal,
                           const glm::vec2& uv)
{
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs[0].push_back(uv);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

} // namespace estampe::shapes
