// SPDX-License-Identifier: MIT
#pragma once

// The cloth of a scene: its sheets, the solids with which they collide, and the time up to which they are
// simulated.

#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/cloth/cloth_solids.hpp"
#include "features/common/style_tables.hpp"
#include "techniques/cloth/cloth.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The simulation from the present state of the cloth sheets to the time of a picture.
struct ClothRun {
    bool starts_anew = false;
    /// True after recall() of a saved state: the nodes that hold the sheets must be posed before the
    /// simulation starts.
    bool is_taken_up = false;
    double from_s = 0.0; ///< Scene time at which the simulation starts; before 0 the scene looks as at 0
    double to_s = 0.0;
    std::optional<double> snapshot_s; ///< Time at which the sheets' state is saved for motion vectors
};

/// Steps of the cloth simulation that go into one graph.
struct ClothSteps {
    double from_s = 0.0; ///< Scene time at which the steps start
    double to_s = 0.0;
    uint32_t count = 0;
    cloth::Surroundings surroundings;
    bool takes_snapshot = false; ///< The state of the sheets before these steps is saved for motion vectors
};

/// The scene's pose at one time, for cloth.
struct ClothPose {
    const ScenePose& nodes;
    const pose::PoseData& draws;
    double time_s = 0.0;
};

class MovingCloth {
public:
    /// Returns whether any object of `scene` is cloth.
    [[nodiscard]] static bool is_in(const Scene& scene);

    /// Makes the cloth sheets of a scene. Throws Error if a sheet cannot be made, as cloth::build_structure()
    /// does.
    MovingCloth(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);

    [[nodiscard]] cloth::Cloths& sheets() { return sheets_; }

    /// Returns the draw calls that are cloth sheets, in ascending order; the simulation replaces the posed
    /// vertices of these draw calls.
    [[nodiscard]] std::span<const uint32_t> draws() const { return draws_; }

    /// Returns the simulation that a picture needs; none if the sheets already have the picture's state.
    /// `before_s` is the earlier time from which motion is measured.
    [[nodiscard]] std::optional<ClothRun> plan(const RenderSettings& settings, const StyleTables& style,
                                               std::optional<double> before_s) const;

    /// Splits the time between two moments into simulation steps; empty unless `to_s` is later than `from_s`.
    /// `anchor` is the origin of all positions on the device.
    [[nodiscard]] std::vector<ClothSteps> steps_between(double from_s, double to_s, const Scene& scene,
                                                        const StyleTables& style,
                                                        const RenderSettings& settings,
                                                        const glm::dvec3& anchor) const;

    /// Records that simulation steps have run. Must be called when the planned steps up to `time_s` have run.
    void done(const RenderSettings& settings, const StyleTables& style, double time_s);

    /// Places the solids with which cloth sheets collide in this pose.
    void place_solids(gpu::Device& device, const Scene& scene, const ClothPose& pose,
                      const pose::MeshData& layout, cloth::ClothBodies bodies);

    /// Makes the next pose of the solids also valid for the beginning of the next simulation run. Solids are
    /// then not interpolated from an older pose.
    void forget_before()
    {
        sheets_.forget_before();
        joints_seen_.clear();
    }

    /// Renders the bodies' depth maps for collisions, if the style uses them and the bodies' pose changed.
    void add_bodies(gpu::Graph& graph, cloth::Cloths::Handles& handles, const pose::PoseData& pose,
                    gpu::BufferId posed_vertices);

    /// Declares simulation steps. Sheets are held at vertices in the pose at the end of the steps. Solids
    /// must have been placed for that time.
    void add_steps(gpu::Graph& graph, cloth::Cloths::Handles& handles, const ClothSteps& steps,
                   const pose::PoseData& pose, const glm::dvec3& anchor, gpu::BufferId posed_vertices);

    /// Returns the boxes that the cloth sheets occupied since the last call (relative to the scene's anchor);
    /// the box is infinite if nothing limits where a sheet may move.
    [[nodiscard]] std::vector<Bounds> sweep(const pose::PoseData& pose);

    /// Returns the transforms that move the cloth sheets along with the nodes that hold them, since the last
    /// call. Empty unless a node that holds a sheet jumped within the time `time_s`, or the anchor (the
    /// origin of positions on the device) moved.
    [[nodiscard]] std::vector<glm::mat4> carries(const pose::PoseData& pose, const glm::dvec3& anchor,
                                                 double time_s);

    /// Makes the simulation start again with the next picture.
    void forget() { time_s_.reset(); }

    /// Sets the time up to which the sheets are simulated.
    void stands_at(double time_s) { time_s_ = time_s; }

    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    /// Restores a saved state, from which the next picture continues.
    void recall(double time_s, std::vector<gpu::Buffer> state)
    {
        sheets_.recall(std::move(state));
        places_before_.clear();
        joints_seen_.clear();
        time_s_ = time_s;
        is_still_ = false;
        is_taken_up_ = true;
    }

    /// Continues from the cloth sheets of another layout, if they are the same sheets. The caller checks that
    /// the anchor (the origin of positions on the device) is unchanged.
    void go_on_from(MovingCloth& other);

    /// Collapses torn triangles of `layout` and restores triangles that are not torn. Returns whether any
    /// triangle changed. `torn` is the content of sheets().torn().
    [[nodiscard]] bool tear_triangles(pose::MeshData& layout, std::span<const glm::uvec2> torn) const;

    bool has_moved = false; ///< The sheets' vertices on the device are out of date

private:
    struct Cut {
        std::vector<uint32_t> draws; ///< Draw call of each cloth sheet
        std::vector<cloth::Sheet> sheets;
        std::vector<cloth::DrawnSheet> drawn;
    };

    /// Returns wind, time and origin for the simulation steps that begin at a time.
    [[nodiscard]] cloth::Surroundings surroundings(double time_s, const StyleTables& style,
                                                   const RenderSettings& settings,
                                                   const glm::dvec3& anchor) const;
    [[nodiscard]] std::vector<glm::mat4> places_of_draws(const pose::PoseData& pose) const;
    [[nodiscard]] std::vector<SheetPlace> sheet_places(const pose::PoseData& pose) const;

    /// Returns boxes that contain the cloth sheets between the last pose and this one; empty if nothing
    /// limits where a sheet may move.
    [[nodiscard]] std::vector<cloth::SheetReach> stays_in(std::span<const SheetPlace> now);
    void tell_bodies(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);
    [[nodiscard]] static Cut cut(const Scene& scene, const pose::MeshData& layout);
    MovingCloth(gpu::Device& device, Cut&& cut);

    /// Where a cloth sheet comes from: node, primitive of the node's mesh, and instance.
    using CutFrom = std::tuple<Index, uint32_t, uint32_t>;

    cloth::Cloths sheets_;
    std::vector<uint32_t> draws_;
    std::vector<CutFrom> cut_from_; ///< For each cloth sheet: where it comes from
    std::vector<BoneCapsule> bones_;
    /// Bodies with depth maps; made when the style first needs depth maps.
    std::optional<std::vector<SeenBody>> bodies_;
    bool are_seen_ = false;              ///< Bodies collide by their depth maps, not by capsules
    std::vector<glm::mat4> joints_seen_; ///< Pose of the bodies when their depth maps were drawn
    std::vector<float> morphs_seen_;
    SolidGrids grids_;
    std::vector<Bounds> reaches_; ///< Bounds of each cloth sheet, in object space
    bool all_hang_ = false;       ///< Every particle of the sheets is connected to a held particle
    std::vector<cloth::SheetReach> stayed_in_; ///< Boxes of the sheets since the last pose
    std::vector<Bounds> swept_before_;
    std::vector<glm::mat4> places_before_;
    glm::dvec3 anchor_before_{0.0};
    std::optional<double> time_s_;
    bool is_still_ = false; ///< The last picture was a still, not a frame of a film
    bool is_taken_up_ = false;
    uint32_t animation_ = 0;
    wind::WindStyle wind_;
    cloth::ClothStyle style_;
};

} // namespace estampe::features
