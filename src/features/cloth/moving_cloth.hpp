// SPDX-License-Identifier: MIT
#pragma once

// The cloth of a scene: which draws are sheets, what they run into, and how far they have come.

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

/// Steps that lie between what sheets are and what a picture shows.
struct ClothRun {
    bool starts_anew = false;
    bool is_taken_up = false; ///< after recall(): what sheets hang on has to be put where it was
    double from_s = 0.0;      ///< of the scene's time; before 0 the scene stands as it does then
    double to_s = 0.0;
    std::optional<double> snapshot_s; ///< where the picture wants to know how sheets were before
};

/// Steps of a run that one graph takes.
struct ClothSteps {
    double from_s = 0.0; ///< of the scene's time
    double to_s = 0.0;
    uint32_t count = 0;
    cloth::Surroundings surroundings;
    bool takes_snapshot = false; ///< of sheets as they are before
};

/// The scene at a moment, as cloth has to know it.
struct ClothPose {
    const ScenePose& nodes;
    const pose::PoseData& draws;
    double time_s = 0.0;
};

class MovingCloth {
public:
    /// Whether anything of `scene` is cloth.
    [[nodiscard]] static bool is_in(const Scene& scene);

    /// Throws Error for sheets that cannot be made, as cloth::build_structure() does.
    MovingCloth(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);

    [[nodiscard]] cloth::Cloths& sheets() { return sheets_; }

    /// In ascending order; vertices of a sheet take the place of posed ones.
    [[nodiscard]] std::span<const uint32_t> draws() const { return draws_; }

    /// What is to be done before a picture; nothing where sheets are as it wants them. `before_s` is the
    /// moment that motion is told from.
    [[nodiscard]] std::optional<ClothRun> plan(const RenderSettings& settings, const StyleTables& style,
                                               std::optional<double> before_s) const;

    /// The way from one moment to another, before a picture; nothing where the one is not later. `anchor` is
    /// the place that places are told from.
    [[nodiscard]] std::vector<ClothSteps> steps_between(double from_s, double to_s, const Scene& scene,
                                                        const StyleTables& style,
                                                        const RenderSettings& settings,
                                                        const glm::dvec3& anchor) const;

    /// To be called when of what was planned all has been done that comes before `time_s`.
    void done(const RenderSettings& settings, const StyleTables& style, double time_s);

    /// Tells sheets where solids are in this pose.
    void place_solids(gpu::Device& device, const Scene& scene, const ClothPose& pose,
                      const pose::MeshData& layout, cloth::ClothBodies bodies);

    /// What is told next holds for the beginning of the next run too.
    void forget_before()
    {
        sheets_.forget_before();
        joints_seen_.clear();
    }

    /// Looks at bodies, if that is what they are to cloth and they are posed otherwise than when it last did.
    void add_bodies(gpu::Graph& graph, cloth::Cloths::Handles& handles, const pose::PoseData& pose,
                    gpu::BufferId posed_vertices);

    /// Takes steps: sheets hang on vertices as they are posed at the end, where solids have been placed too.
    void add_steps(gpu::Graph& graph, cloth::Cloths::Handles& handles, const ClothSteps& steps,
                   const pose::PoseData& pose, const glm::dvec3& anchor, gpu::BufferId posed_vertices);

    /// The boxes that sheets were in since the last call (anchor space), and one without end where any of
    /// them may come anywhere.
    [[nodiscard]] std::vector<Bounds> sweep(const pose::PoseData& pose);

    /// Where sheets are carried to since the last call: none, unless one hangs on what was put elsewhere
    /// within `time_s`, or the anchor moved.
    [[nodiscard]] std::vector<glm::mat4> carries(const pose::PoseData& pose, const glm::dvec3& anchor,
                                                 double time_s);

    /// The next picture is of something else.
    void forget() { time_s_.reset(); }

    /// Steps up to then have run.
    void stands_at(double time_s) { time_s_ = time_s; }

    [[nodiscard]] std::optional<double> time_s() const { return time_s_; }

    /// The next picture goes on from sheets as they were then.
    void recall(double time_s, std::vector<gpu::Buffer> state)
    {
        sheets_.recall(std::move(state));
        places_before_.clear();
        joints_seen_.clear();
        time_s_ = time_s;
        is_still_ = false;
        is_taken_up_ = true;
    }

    /// The next picture goes on from where the same sheets stood that were cut from another layout, told from
    /// the same anchor; of others nothing is taken.
    void go_on_from(MovingCloth& other);

    /// Lets triangles of `layout` fall together that are torn, and puts back those that are not; returns
    /// whether any is otherwise than before. `torn` is what sheets().torn() holds.
    [[nodiscard]] bool tear_triangles(pose::MeshData& layout, std::span<const glm::uvec2> torn) const;

    bool has_moved = false; ///< the device has yet to pose the sheets' vertices

private:
    struct Cut {
        std::vector<uint32_t> draws; ///< one a sheet
        std::vector<cloth::Sheet> sheets;
        std::vector<cloth::DrawnSheet> drawn;
    };

    /// What sheets are in at a moment on the way to a picture.
    [[nodiscard]] cloth::Surroundings surroundings(double time_s, const Scene& scene,
                                                   const StyleTables& style, const RenderSettings& settings,
                                                   const glm::dvec3& anchor) const;
    [[nodiscard]] std::vector<glm::mat4> places_of_draws(const pose::PoseData& pose) const;
    [[nodiscard]] std::vector<SheetPlace> sheet_places(const pose::PoseData& pose) const;

    /// What sheets stay in between the last pose and this; nothing where one of them may come anywhere.
    [[nodiscard]] std::vector<cloth::SheetReach> stays_in(std::span<const SheetPlace> now);
    void tell_bodies(gpu::Device& device, const Scene& scene, const pose::MeshData& layout);
    [[nodiscard]] static Cut cut(const Scene& scene, const pose::MeshData& layout);
    MovingCloth(gpu::Device& device, Cut&& cut);

    /// What a sheet is cut from: a node, a primitive of its mesh, an instance.
    using CutFrom = std::tuple<Index, uint32_t, uint32_t>;

    cloth::Cloths sheets_;
    std::vector<uint32_t> draws_;
    std::vector<CutFrom> cut_from_; ///< one a sheet
    std::vector<BoneCapsule> bones_;
    std::optional<std::vector<SeenBody>> bodies_; ///< from when they are asked for
    bool are_seen_ = false;                       ///< in place of capsules
    std::vector<glm::mat4> joints_seen_;          ///< how bodies were posed when they were last looked at
    std::vector<float> morphs_seen_;
    SolidGrids grids_;
    std::vector<Bounds> reaches_;              ///< one a sheet, in object space
    bool all_hang_ = false;                    ///< every particle of every sheet on one that is held
    std::vector<cloth::SheetReach> stayed_in_; ///< in the last pose
    std::vector<Bounds> swept_before_;
    std::vector<glm::mat4> places_before_;
    glm::dvec3 anchor_before_{0.0};
    std::optional<double> time_s_;
    bool is_still_ = false; ///< and nothing but a still's
    bool is_taken_up_ = false;
    uint32_t animation_ = 0;
    cloth::WindStyle wind_;
    cloth::ClothStyle style_;
};

} // namespace estampe::features
