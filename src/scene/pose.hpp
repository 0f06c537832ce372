// SPDX-License-Identifier: MIT
#pragma once

// Evaluates the scene at a moment, vertex by vertex, on the CPU, for bounds and framing.

#include <functional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// world_from_bind for every joint of the skin of `node`, in the order of Skin::joints; empty without a skin.
/// A skinned vertex is the sum of weight * matrix[joint] * position; the transform of the node itself has no
/// effect.
[[nodiscard]] std::vector<glm::mat4> skin_matrices(const Scene& scene, const ScenePose& pose, Index node);

/// One primitive in world space. `positions` has one entry per vertex and is valid until the visitor returns.
struct PosedPrimitive {
    Index node = no_index;
    const Primitive* primitive = nullptr;
    std::span<const glm::dvec3> positions;
    bool mirrored = false; ///< the node mirrors the mesh, so that the winding of triangles is reversed
};

/// Calls `visit` once for each visible primitive and instance of a node, after morphing and skinning. Ignores
/// instances of a skinned mesh, because the skin alone places it. Cost: linear in vertices drawn.
void visit_posed(const Scene& scene, const ScenePose& pose,
                 const std::function<void(const PosedPrimitive&)>& visit);

/// As visit_posed(), but `positions` has only every n-th vertex, with the smallest n that leaves fewer than
/// twice `about` of them. Cost: linear in visited vertices.
void visit_posed_samples(const Scene& scene, const ScenePose& pose, size_t about,
                         const std::function<void(const PosedPrimitive&)>& visit);

} // namespace estampe
