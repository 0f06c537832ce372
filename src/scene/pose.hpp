// SPDX-License-Identifier: MIT
#pragma once

// The scene at a moment, vertex by vertex, on the processor: what bounds and framing are made of.

#include <functional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// world_from_bind for every joint of the skin of `node`, in the order of Skin::joints; empty without a skin.
/// A skinned vertex is the sum of weight * matrix[joint] * position: the place of the node itself does not
/// count.
[[nodiscard]] std::vector<glm::mat4> skin_matrices(const Scene& scene, const ScenePose& pose, Index node);

/// One primitive as it stands in the world. `positions` has one entry per vertex and lives until the visit
/// returns.
struct PosedPrimitive {
    Index node = no_index;
    const Primitive* primitive = nullptr;
    std::span<const glm::dvec3> positions;
    bool mirrored = false; ///< the node turns the mesh inside out: triangles run the other way round
};

/// Calls `visit` once for each primitive and instance that a node shows, morphed, then skinned.
/// Instances of a skinned mesh are ignored, as the skin alone places it. Cost: linear in vertices drawn.
void visit_posed(const Scene& scene, const ScenePose& pose,
                 const std::function<void(const PosedPrimitive&)>& visit);

/// The same, with `positions` of every n-th vertex alone: of the least n that leaves fewer than twice `about`
/// of them. Cost: linear in what is visited.
void visit_posed_samples(const Scene& scene, const ScenePose& pose, size_t about,
                         const std::function<void(const PosedPrimitive&)>& visit);

} // namespace estampe
