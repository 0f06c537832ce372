// SPDX-License-Identifier: MIT
#pragma once

// What of a scene never moves, as plain triangles: what light can be worked out for ahead.

#include <array>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// One primitive of triangles in one place of the scene.
struct StaticDraw {
    Index node = 0;
    uint32_t primitive = 0; ///< of the node's mesh
    uint32_t instance = 0;  ///< into Node::instances; 0 when there are none
    Index material = 0;
    uint32_t first_triangle = 0;
    uint32_t triangle_count = 0;
};

/// Three entries a triangle in each list, in the order of the primitives' indices.
struct StaticTriangles {
    glm::dvec3 anchor{0.0}; ///< the centre of the scene's rest pose; positions are relative to it
    std::vector<StaticDraw> draws;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< unit
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec3> colors; ///< empty where no primitive has any
    std::vector<bool> has_uv_1;    ///< one a draw

    [[nodiscard]] size_t count() const { return positions.size() / 3; }
};

/// The triangles that no animation, skin or morph target moves, node by node, primitive by primitive,
/// instance by instance. Cost: linear in triangles drawn.
[[nodiscard]] StaticTriangles static_triangles(const Scene& scene);

/// Nodes that an animation moves, by themselves or with a parent, as one flag a node. Cost: linear in nodes
/// and channels.
[[nodiscard]] std::vector<bool> moving_nodes(const Scene& scene);

/// Whether a primitive of a node can move, given moving_nodes(): with its node, by a skin, by morph targets,
/// or as cloth.
[[nodiscard]] bool can_move(const Scene& scene, const std::vector<bool>& moving, Index node,
                            const Primitive& primitive);

/// Whether anything that is drawn can move.
[[nodiscard]] bool has_moving_parts(const Scene& scene);

/// Sixteen digits that change with the places of the triangles, and with nothing else.
[[nodiscard]] std::string geometry_fingerprint(const StaticTriangles& triangles);

} // namespace estampe
