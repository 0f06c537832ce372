// SPDX-License-Identifier: MIT
#pragma once

// Computes the positions of all vertices of the scene at a moment, on the CPU, for bounds and framing.

#include <functional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Returns the matrices world_from_bind of all joints of the skin of `node`, in the order of Skin::joints;
/// empty without a skin. The position of a skinned vertex is the sum of weight * matrix[joint] * position
/// over its joints. The transform of the node itself has no effect.
[[nodiscard]] std::vector<glm::mat4> skin_matrices(const Scene& scene, const ScenePose& pose, Index node);

/// One primitive of one node, with vertex positions in world space. `positions` has one entry per vertex, and
/// is valid until the visitor returns.
struct PosedPrimitive {
    Index node = no_index;
    const Primitive* primitive = nullptr;
    std::span<const glm::dvec3> positions;
    bool mirrored = false; ///< the node's transform is a mirroring, which reverses the winding of triangles
    glm::dmat4 world_from_mesh{1.0};      ///< placement of a primitive without a skin
    std::span<const glm::dmat4> joints{}; ///< matrices world_from_bind of a skinned primitive; else empty
};

/// Returns the matrix that places a vertex of a primitive in the world after morphing: the primitive's
/// placement, or the weighted sum of the matrices of the vertex's joints.
[[nodiscard]] glm::dmat4 world_from_vertex(const PosedPrimitive& posed, size_t vertex);

/// Calls `visit` once for each primitive and instance of each visible node, after morphing and skinning.
/// Ignores instances of skinned meshes, because only the joints place such a mesh. Cost: linear in vertices
/// drawn.
void visit_posed(const Scene& scene, const ScenePose& pose,
                 const std::function<void(const PosedPrimitive&)>& visit);

/// Like visit_posed(), but visits only every n-th vertex. Here n is the smallest step between visited
/// vertices for which fewer than twice `about` vertices are visited. Cost: linear in visited vertices.
void visit_posed_samples(const Scene& scene, const ScenePose& pose, size_t about,
                         const std::function<void(const PosedPrimitive&)>& visit);

} // namespace estampe
