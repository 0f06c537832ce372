// SPDX-License-Identifier: MIT
#pragma once

// Capsules about the bones of skinned bodies, for cloth to lie on.

#include <vector>

#include <estampe/scene.hpp>

#include "techniques/cloth/solids/colliders.hpp"

namespace estampe::features {

/// From a joint to one below it.
struct BoneCapsule {
    Index from = 0; ///< nodes
    Index to = 0;
    float radius_share = 0.0F; ///< of the bone's length
};

/// One for each bone that moves some of a body: as thick as its vertices lie about it, at the median. Cloth
/// has none. Cost: linear in skinned vertices.
[[nodiscard]] std::vector<BoneCapsule> bone_capsules(const Scene& scene);

/// Where it is in a pose.
[[nodiscard]] cloth::Solid placed_bone(const BoneCapsule& bone, const ScenePose& pose,
                                       const glm::dvec3& anchor);

} // namespace estampe::features
