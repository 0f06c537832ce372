// SPDX-License-Identifier: MIT
#pragma once

// Collects the parts of a scene that never move as plain triangles, so that their light can be baked.

#include <array>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// One primitive of triangles, drawn for one node or instance of the scene.
struct StaticDraw {
    Index node = 0;
    uint32_t primitive = 0; ///< index into the primitives of the node's mesh
    uint32_t instance = 0;  ///< index into Node::instances; 0 if the node has no instances
    Index material = 0;
    uint32_t first_triangle = 0;
    uint32_t triangle_count = 0;
};

/// The triangles of a scene that never move. Each vertex list has three entries per triangle, in the order of
/// the primitives' indices.
struct StaticTriangles {
    glm::dvec3 anchor{0.0}; ///< the centre of the scene's rest pose; positions are relative to it
    std::vector<StaticDraw> draws;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< normals of the vertices, unit vectors
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec3> colors; ///< colours of the vertices; empty if no primitive has vertex colours
    std::vector<bool> has_uv_1; ///< for each StaticDraw: whether it has a second set of texture coordinates

    [[nodiscard]] size_t count() const { return positions.size() / 3; }
};

/// Collects the triangles that no animation, skin or morph target moves, sorted by node, primitive and
/// instance. Cost: linear in triangles drawn.
[[nodiscard]] StaticTriangles static_triangles(const Scene& scene);

/// Returns for each node whether an animation moves the node or one of its ancestors. Cost: linear in nodes
/// and animation channels.
[[nodiscard]] std::vector<bool> moving_nodes(const Scene& scene);

/// Returns whether a primitive of a node can move: with its node, by a skin, by morph targets, or as cloth.
/// `moving` is the result of moving_nodes().
[[nodiscard]] bool can_move(const Scene& scene, const std::vector<bool>& moving, Index node,
                            const Primitive& primitive);

/// Returns whether any drawn object can move.
[[nodiscard]] bool has_moving_parts(const Scene& scene);

/// Returns a hash (16 hexadecimal digits) of the positions of the triangles and of the order of the draws.
[[nodiscard]] std::string geometry_fingerprint(const StaticTriangles& triangles);

} // namespace estampe
