// SPDX-License-Identifier: MIT
#pragma once

// The solids that cloth collides with: capsules around the bones of skinned bodies, front and back depth
// maps of these bodies, and grids of the ground's heights and of distances to meshes.

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

/// A capsule between a joint and one of its children.
struct BoneCapsule {
    Index from = 0; ///< scene node of the parent joint
    Index to = 0;
    float radius_share = 0.0F; ///< radius relative to the bone's length
};

/// One capsule per bone that moves part of a body. The capsule's radius is the median distance of the bone's
/// vertices. Bones of cloth get none. Cost: linear in skinned vertices.
[[nodiscard]] std::vector<BoneCapsule> bone_capsules(const Scene& scene);

/// The capsule in a pose.
[[nodiscard]] cloth::Solid placed_bone(const BoneCapsule& bone, const ScenePose& pose,
                                       const glm::dvec3& anchor);

/// All draw calls of one skeleton except cloth. The depth maps look along the shortest side of the body's box
/// in the bind pose. This axis rotates with the joint that moves most of the body's surface.
struct SeenBody {
    /// The vertices that one joint moves, in the bind pose.
    struct Part {
        uint32_t draw = 0;
        uint32_t joint = 0; ///< index into the skin's joints
        glm::vec3 min_m{0.0F};
        glm::vec3 max_m{0.0F};
        double area_m2 = 0.0;
    };

    cloth::Body mesh;
    std::vector<Part> parts; ///< the first part is the one whose joint rotates the axis
    cloth::Solid solid;      ///< in the bind pose
};

/// The bodies of a scene, in the order of the scene's draw calls. Cost: linear in skinned triangles.
[[nodiscard]] std::vector<SeenBody> seen_bodies(const Scene& scene, const pose::MeshData& layout);

/// The body in a pose (anchor space), in a box that contains every part that the body's joints move. Vertices
/// that morph targets move outside this box are cut off.
[[nodiscard]] cloth::Solid placed_body(const SeenBody& body, const pose::MeshData& layout,
                                       const pose::PoseData& pose, uint32_t number);

/// The position of a sheet, in anchor space.
struct SheetPlace {
    Bounds box;
    std::optional<Bounds> stays_in; ///< box that the sheet never leaves; none means no limits
};

class SolidGrids {
public:
    SolidGrids() = default;

    /// Makes distance grids, 40 cells along the longest side, for all colliders of kind mesh. Cost: see
    /// cloth::grid_of_distances().
    explicit SolidGrids(const Scene& scene);

    /// Samples the heights of the ground below the sheets that may reach it, every half second. Returns
    /// whether the heights changed. On slopes steeper than sand, features narrower than a quarter of a sheet
    /// may be missed. Cost when ground or sheets changed: 25 samples of the ground per sheet with a bounded
    /// reach, and up to 9,409 below sheets that may touch it; otherwise none.
    bool follow_ground(const Scene& scene, std::span<const SheetPlace> sheets, const glm::dvec3& anchor,
                       double time_s);

    [[nodiscard]] const std::vector<cloth::SolidGrid>& grids() const { return grids_; }

    /// The ground's heights in anchor space; none if no sheet may reach the ground.
    [[nodiscard]] std::optional<cloth::Solid> ground() const;

    /// A mesh collider placed by a matrix; none if the mesh has no triangles.
    [[nodiscard]] std::optional<cloth::Solid> placed_mesh(Index mesh, const glm::dmat4& place) const;

private:
    struct GroundKey {
        glm::dvec4 box_m{0.0};
        glm::dvec3 anchor{0.0};
        double time_s = 0.0;
        const terrain::Program* program = nullptr;
        std::vector<double> lows_m; ///< lowest heights that sheets may reach, in steps of a quarter metre

        bool operator==(const GroundKey&) const = default;
    };

    std::vector<cloth::SolidGrid> grids_; ///< with a terrain, the first grid holds the ground's heights
    std::map<std::pair<Index, bool>, uint32_t> of_mesh_; ///< key: mesh, and whether it is mirrored
    std::optional<GroundKey> ground_;
    bool is_ground_near_ = false;
    std::optional<Terrain> terrain_; ///< keeps the program in `ground_` alive
};

} // namespace estampe::features
