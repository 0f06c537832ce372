// SPDX-License-Identifier: MIT
#pragma once

// Which vertices have to be posed anew.

#include <span>

#include "core/inline_vector.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/pose/pose_variant.glsl.h"

namespace estampe::pose {

/// Consecutive posed vertices.
struct VertexRun {
    uint32_t first = 0;
    uint32_t count = 0;
    bool operator==(const VertexRun&) const = default;
};

using VertexRuns = InlineVector<VertexRun, shared::most_pose_runs>;

/// The vertices that stand otherwise in `now` than in `before`, all of them where that is null, and those of
/// the draws `written_over`, which are in ascending order. What lies between the nearest of many runs is in
/// them as well. Cost: linear in draws, joints and weights.
[[nodiscard]] VertexRuns runs_to_pose(const MeshData& meshes, const PoseData* before, const PoseData& now,
                                      std::span<const uint32_t> written_over);

} // namespace estampe::pose
