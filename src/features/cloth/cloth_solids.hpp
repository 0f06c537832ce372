// SPDX-License-Identifier: MIT
#pragma once

// The solids that cloth collides with: capsules around the bones of skinned bodies, front and back depth maps
// of skinned bodies, and grids of the ground's heights and of distances to meshes.

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

/// A capsule around a bone, from a joint to one of its children, with which cloth collides.
struct BoneCapsule {
    Index from = 0; ///< Scene node of the bone's parent joint
    Index to = 0;
    float radius_share = 0.0F; ///< Radius of the capsule relative to the bone's length
};

/// Makes one capsule for each bone that moves part of a body. The capsule's radius is the median distance of
/// the bone's vertices. Bones that move cloth get no capsule. Cost: linear in skinned vertices.
[[nodiscard]] std::vector<BoneCapsule> bone_capsules(const Scene& scene);

/// Places a bone's capsule in a pose of the scene.
[[nodiscard]] cloth::Solid placed_bone(const BoneCapsule& bone, const ScenePose& pose,
                                       const glm::dvec3& anchor);

/// A body with which cloth collides: all draw calls of one skeleton except cloth. The body's depth maps are
/// taken along the shortest side of the body's box in the bind pose. The direction of the depth maps rotates
/// with the joint that moves most of the body's surface.
struct SeenBody {
    /// The vertices of a body that one joint moves, in the bind pose.
    struct Part {
        uint32_t draw = 0;
        uint32_t joint = 0; ///< Joint that moves the part, as an index of the skin's joints
        glm::vec3 min_m{0.0F};
        glm::vec3 max_m{0.0F};
        double area_m2 = 0.0;
    };

    cloth::Body mesh;
    /// Parts of the body; the first part is moved by the joint that also rotates the depth maps' axis.
    std::vector<Part> parts;
    cloth::Solid solid; ///< Collider of the body in the bind pose
};

/// Finds the bodies of a scene, in the order of the scene's draw calls. Cost: linear in skinned triangles.
[[nodiscard]] std::vector<SeenBody> seen_bodies(const Scene& scene, const pose::MeshData& layout);

/// Places a body in a pose (relative to the scene's anchor), in a box that contains every part that the
/// body's joints move. Vertices that morph targets move out of this box do not collide.
[[nodiscard]] cloth::Solid placed_body(const SeenBody& body, const pose::MeshData& layout,
                                       const pose::PoseData& pose, uint32_t number);

/// The position of a cloth sheet, in anchor space (relative to the scene's anchor).
struct SheetPlace {
    Bounds box;
    std::optional<Bounds> stays_in; ///< Box that the cloth sheet never leaves; none: no limits
};

class SolidGrids {
public:
    SolidGrids() = default;

    /// Makes grids of distances to the mesh, with 40 cells along the longest side, for all colliders of kind
    /// mesh. Cost: see cloth::grid_of_distances().
    explicit SolidGrids(const Scene& scene);

    /// Samples the heights of the ground below the cloth sheets that may reach it, every half second. Returns
    /// whether the heights changed. On slopes steeper than sand, features of the ground narrower than a
    /// quarter of a sheet may be missed. Cost if ground or sheets changed: 25 samples of the ground per sheet
    /// with a bounded reach, and up to 9,409 samples below sheets that may touch the ground.
    bool follow_ground(const Scene& scene, std::span<const SheetPlace> sheets, const glm::dvec3& anchor,
                       double time_s);

    [[nodiscard]] const std::vector<cloth::SolidGrid>& grids() const { return grids_; }

    /// Returns the ground's heights in anchor space (relative to the scene's anchor), for collisions of
    /// cloth; none if no sheet may reach the ground.
    [[nodiscard]] std::optional<cloth::Solid> ground() const;

    /// Returns a mesh collider placed by a matrix; none if the mesh has no triangles.
    [[nodiscard]] std::optional<cloth::Solid> placed_mesh(Index mesh, const glm::dmat4& place) const;

private:
    struct GroundKey {
        glm::dvec4 box_m{0.0};
        glm::dvec3 anchor{0.0};
        double time_s = 0.0;
        const terrain::Program* program = nullptr;
        /// For each sheet: lowest height that it may reach, rounded to a quarter metre.
        std::vector<double> lows_m;

        bool operator==(const GroundKey&) const = default;
    };

    /// Grids of all colliders; with a terrain, the first grid holds the ground's heights.
    std::vector<cloth::SolidGrid> grids_;
    /// For each mesh: index of its grid. The key is the mesh, and whether it is mirrored.
    std::map<std::pair<Index, bool>, uint32_t> of_mesh_;
    std::optional<GroundKey> ground_;
    bool is_ground_near_ = false;
    std::optional<Terrain> terrain_; ///< Keeps the compiled height graph of `ground_` alive
};

} // namespace estampe::features
