// SPDX-License-Identifier: MIT
#pragma once

// The parts of a scene that never move, as plain triangles; their light can be baked.

#include <array>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// One primitive of triangles at one place of the scene.
struct StaticDraw {
    Index node = 0;
    uint32_t primitive = 0; ///< index into the primitives of the node's mesh
    uint32_t instance = 0;  ///< index into Node::instances; 0 when there are none
    Index material = 0;
    uint32_t first_triangle = 0;
    uint32_t triangle_count = 0;
};

/// Three entries per triangle in each list, in the order of the primitives' indices.
struct StaticTriangles {
    glm::dvec3 anchor{0.0}; ///< the centre of the scene's rest pose; positions are relative to it
    std::vector<StaticDraw> draws;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< unit
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec3> colors; ///< empty if no primitive has vertex colours
    std::vector<bool> has_uv_1;    ///< one per StaticDraw

    [[nodiscard]] size_t count() const { return positions.size() / 3; }
};

/// The triangles that no animation, skin or morph target moves, sorted by node, primitive and instance. Cost:
/// linear in triangles drawn.
[[nodiscard]] StaticTriangles static_triangles(const Scene& scene);

/// One flag per node: whether an animation moves the node or one of its ancestors. Cost: linear in nodes and
/// channels.
[[nodiscard]] std::vector<bool> moving_nodes(const Scene& scene);

/// Whether a primitive of a node can move, by its node (`moving` is the result of moving_nodes()), a skin,
/// morph targets or as cloth.
[[nodiscard]] bool can_move(const Scene& scene, const std::vector<bool>& moving, Index node,
                            const Primitive& primitive);

/// Whether anything drawn can move.
[[nodiscard]] bool has_moving_parts(const Scene& scene);

/// Sixteen digits that depend only on the positions of the triangles.
[[nodiscard]] std::string geometry_fingerprint(const StaticTriangles& triangles);

} // namespace estampe
