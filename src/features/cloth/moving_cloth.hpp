// SPDX-License-Identifier: MIT
#pragma once

// The cloth of a scene: which draws are sheets, what they collide with, and up to which moment they are
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

/// The simulation from the sheets' present state to a picture's moment.
struct ClothRun {
    bool starts_anew = false;
    bool is_taken_up = false; ///< after recall(): what holds the sheets must be posed first
    double from_s = 0.0;      ///< scene time; before 0 the scene stands as at 0
    double to_s = 0.0;
    std::optional<double> snapshot_s; ///< when to keep the sheets' state for motion vectors
};

/// Steps of a run that go into one graph.
struct ClothSteps {
    double from_s = 0.0; ///< scene time
    double to_s = 0.0;
    uint32_t count = 0;
    cloth::Surroundings surroundings;
    bool takes_snapshot = false; ///< of the state before these steps
};

/// The scene's pose at a moment.
struct ClothPose {
    const ScenePose& nodes;
    const pose::PoseData& draws;
    double time_s = 0.0;
};

class MovingCloth {
public:
    /// Whether anything of `scene` is cloth.
    [[nodiscard]] static bool is_in(const Scene& scene);

    /// Throws Error if a sheet cannot be made, as cloth::build_structure() does.
    MovingCloth(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);

    [[nodiscard]] cloth::Cloths& sheets() { return sheets_; }

    /// The draws that are sheets, ascending; the simulation replaces their posed vertices.
    [[nodiscard]] std::span<const uint32_t> draws() const { return draws_; }

    /// The simulation that a picture needs; none if the sheets are already as it needs them. `before_s` is
    /// the moment from which motion is measured.
    [[nodiscard]] std::optional<ClothRun> plan(const RenderSettings& settings, const StyleTables& style,
                                               std::optional<double> before_s) const;

    /// Splits the time between two moments into steps; empty unless `to_s` is later. `anchor` is the origin
    /// of anchor space.
    [[nodiscard]] std::vector<ClothSteps> steps_between(double from_s, double to_s, const Scene& scene,
                                                        const StyleTables& style,
                                                        const RenderSettings& settings,
                                                        const glm::dvec3& anchor) const;

    /// Must be called when the planned steps up to `time_s` have run.
    void done(const RenderSettings& settings, const StyleTables& style, double time_s);

    /// Places the solids that sheets collide with in this pose.
    void place_solids(gpu::Device& device, const Scene& scene, const ClothPose& pose,
                      const pose::MeshData& layout, cloth::ClothBodies bodies);

    /// Makes the pose that is set next valid for the beginning of the next run too, without interpolation
    /// from an older pose.
    void forget_before()
    {
        sheets_.forget_before();
        joints_seen_.clear();
    }

    /// Renders the bodies' depth maps, if the style uses them and the bodies' pose changed.
    void add_bodies(gpu::Graph& graph, cloth::Cloths::Handles& handles, const pose::PoseData& pose,
                    gpu::BufferId posed_vertices);

    /// Declares steps. Sheets are held by vertices as posed at the end of the steps; solids must have been
    /// placed for that moment too.
    void add_steps(gpu::Graph& graph, cloth::Cloths::Handles& handles, const ClothSteps& steps,
                   const pose::PoseData& pose, const glm::dvec3& anchor, gpu::BufferId posed_vertices);

    /// The boxes that the sheets occupied since the last call (anchor space); an infinite one if a sheet may
    /// get anywhere.
    [[nodiscard]] std::vector<Bounds> sweep(const pose::PoseData& pose);

    /// Transforms that carry the sheets along since the last call. Empty unless what holds a sheet jumped
    /// within `time_s`, or the anchor moved.
    [[nodiscard]] std::vector<glm::mat4> carries(const pose::PoseData& pose, const glm::dvec3& anchor,
                                                 double time_s);

    /// The next picture starts the simulation again.
    void forget() { time_s_.reset(); }

    /// Records that the steps up to `time_s` have run.
    void stands_at(double time_s) { time_s_ = time_s; }

    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    /// The next picture continues from this state.
    void recall(double time_s, std::vector<gpu::Buffer> state)
    {
        sheets_.recall(std::move(state));
        places_before_.clear();
        joints_seen_.clear();
        time_s_ = time_s;
        is_still_ = false;
        is_taken_up_ = true;
    }

    /// Continues from the sheets of another layout, if they are the same sheets. The caller checks that the
    /// anchor is the same.
    void go_on_from(MovingCloth& other);

    /// Collapses torn triangles of `layout` and restores whole ones. Returns whether any triangle changed.
    /// `torn` is the content of sheets().torn().
    [[nodiscard]] bool tear_triangles(pose::MeshData& layout, std::span<const glm::uvec2> torn) const;

    bool has_moved = false; ///< the device must still pose the sheets' vertices

private:
    struct Cut {
        std::vector<uint32_t> draws; ///< one per sheet
        std::vector<cloth::Sheet> sheets;
        std::vector<cloth::DrawnSheet> drawn;
    };

    /// Wind, time and origin for the steps that begin at a moment.
    [[nodiscard]] cloth::Surroundings surroundings(double time_s, const StyleTables& style,
                                                   const RenderSettings& settings,
                                                   const glm::dvec3& anchor) const;
    [[nodiscard]] std::vector<glm::mat4> places_of_draws(const pose::PoseData& pose) const;
    [[nodiscard]] std::vector<SheetPlace> sheet_places(const pose::PoseData& pose) const;

    /// Boxes that contain the sheets between the last pose and this one; empty if a sheet may get anywhere.
    [[nodiscard]] std::vector<cloth::SheetReach> stays_in(std::span<const SheetPlace> now);
    void tell_bodies(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);
    [[nodiscard]] static Cut cut(const Scene& scene, const pose::MeshData& layout);
    MovingCloth(gpu::Device& device, Cut&& cut);

    /// The source of a sheet: node, primitive of its mesh, instance.
    using CutFrom = std::tuple<Index, uint32_t, uint32_t>;

    cloth::Cloths sheets_;
    std::vector<uint32_t> draws_;
    std::vector<CutFrom> cut_from_; ///< one per sheet
    std::vector<BoneCapsule> bones_;
    std::optional<std::vector<SeenBody>> bodies_; ///< made when the style first needs depth maps
    bool are_seen_ = false;                       ///< depth maps replace the capsules
    std::vector<glm::mat4> joints_seen_;          ///< pose of the bodies in the depth maps
    std::vector<float> morphs_seen_;
    SolidGrids grids_;
    std::vector<Bounds> reaches_;              ///< one per sheet, in object space
    bool all_hang_ = false;                    ///< every particle is connected to a held one
    std::vector<cloth::SheetReach> stayed_in_; ///< in the last pose
    std::vector<Bounds> swept_before_;
    std::vector<glm::mat4> places_before_;
    glm::dvec3 anchor_before_{0.0};
    std::optional<double> time_s_;
    bool is_still_ = false; ///< the last picture was a still
    bool is_taken_up_ = false;
    uint32_t animation_ = 0;
    wind::WindStyle wind_;
    cloth::ClothStyle style_;
};

} // namespace estampe::features
