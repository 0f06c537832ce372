// SPDX-License-Identifier: MIT
#pragma once

// Skinned bodies for cloth to lie on, as their front and their back are seen.

#include <vector>

#include <estampe/scene.hpp>

#include "techniques/cloth/cloth.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// All draws of one skeleton that are no cloth. It is seen along the shortest side of the box about it as it
/// was bound, along an axis that goes with the joint which moves most of its surface.
struct SeenBody {
    /// What a joint moves, as it was bound.
    struct Part {
        uint32_t draw = 0;
        uint32_t joint = 0; ///< of its skin
        glm::vec3 min_m{0.0F};
        glm::vec3 max_m{0.0F};
        double area_m2 = 0.0;
    };

    cloth::Body mesh;
    std::vector<Part> parts; ///< the one that it goes with first
    cloth::Solid solid;      ///< as that was bound
};

/// Those of a scene, in the order of its draws. Cost: linear in skinned triangles.
[[nodiscard]] std::vector<SeenBody> seen_bodies(const Scene& scene, const pose::MeshData& layout);

/// Where it is in a pose (anchor space): large enough for all that its joints can do. What morph targets move
/// farther than that is not seen.
[[nodiscard]] cloth::Solid placed_body(const SeenBody& body, const pose::MeshData& layout,
                                       const pose::PoseData& pose, uint32_t number);

} // namespace estampe::features
