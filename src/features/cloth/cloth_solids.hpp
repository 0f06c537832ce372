// SPDX-License-Identifier: MIT
#pragma once

// What cloth runs into: capsules about the bones of skinned bodies, these bodies as their front and their
// back are seen, and by numbers on grids the ground about it and meshes of any form.

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

#include "techniques/cloth/cloth.hpp"
#include "techniques/cloth/solids/solids.hpp"
#include "techniques/pose/mesh_data.hpp"

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

/// Where a sheet hangs, in anchor space.
struct SheetPlace {
    Bounds box;
    std::optional<Bounds> stays_in; ///< however it swings; it may come anywhere where there is none
};

class SolidGrids {
public:
    SolidGrids() = default;

    /// Distances to each mesh that is a collider of its own form, 40 cells long. Cost: see
    /// cloth::grid_of_distances().
    explicit SolidGrids(const Scene& scene);

    /// Heights of the scene's ground under the sheets that may come down to it, at half seconds; returns
    /// whether they are others than before. Of ground that is steeper than sand lies, what is narrower than a
    /// quarter of a sheet may not be seen to come near. Cost: where ground or sheets are others than before
    /// 25 samples of the ground for each that stays somewhere, and up to 9,409 below those that do; else
    /// none.
    bool follow_ground(const Scene& scene, std::span<const SheetPlace> sheets, const glm::dvec3& anchor,
                       double time_s);

    [[nodiscard]] const std::vector<cloth::SolidGrid>& grids() const { return grids_; }

    /// The ground in anchor space, where one was followed that some sheet may come down to.
    [[nodiscard]] std::optional<cloth::Solid> ground() const;

    /// A mesh in its place; nothing for one without triangles.
    [[nodiscard]] std::optional<cloth::Solid> placed_mesh(Index mesh, const glm::dmat4& place) const;

private:
    struct GroundKey {
        glm::dvec4 box_m{0.0};
        glm::dvec3 anchor{0.0};
        double time_s = 0.0;
        const terrain::Program* program = nullptr;
        std::vector<double> lows_m; ///< of what sheets stay in, in quarters of a metre

        bool operator==(const GroundKey&) const = default;
    };

    std::vector<cloth::SolidGrid> grids_;                ///< the ground first, if any
    std::map<std::pair<Index, bool>, uint32_t> of_mesh_; ///< and whether it is mirrored
    std::optional<GroundKey> ground_;
    bool is_ground_near_ = false;
    std::optional<Terrain> terrain_; ///< that it is of
};

} // namespace estampe::features
