// SPDX-License-Identifier: MIT
#pragma once

// Which of what stands still throws its shadow into a piece of the sun's maps.

#include <span>
#include <vector>

#include <estampe/scene.hpp>

#include "techniques/pose/mesh_data.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/shadow/sun/clipmap.hpp"

namespace estampe::features {

/// A draw that throws shadows and stands still for ever.
struct StillCaster {
    pose::Range range;
    Bounds place; ///< in the world
    bool masked = false;
    Groups groups = all_groups;
};

/// Those of a scene, in the order of their triangles. Cost: linear in nodes and triangles.
[[nodiscard]] std::vector<StillCaster> still_casters(const pose::MeshData& layout, const Scene& scene);

/// Adds what of `still` may be seen in a piece, as at most `most` batches or one for each kind: short gaps
/// between them are drawn too. Cost: linear in draws.
void add_casters_within(const shadow::Piece& piece, const shadow::Clipmap& clipmap, const glm::dvec3& anchor,
                        std::span<const StillCaster> still, Groups groups, size_t most,
                        std::vector<raster::Batch>& batches);

} // namespace estampe::features
