// SPDX-License-Identifier: MIT
#pragma once

// Sheets of cloth on the device, all in a few dispatches.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "style/wind.hpp"
#include "techniques/cloth/cloth_style.hpp"
#include "techniques/cloth/sheet/sheet.hpp"
#include "techniques/cloth/solids/solids.hpp"

namespace estampe::cloth {

/// What all sheets are in; any of it may change from run to run.
struct Surroundings {
    float step_s = 1.0F / 120.0F; ///< a thirtieth is the longest there is
    double time_s = 0.0;          ///< at the beginning of the run, for the wind
    glm::vec3 gravity_m_s2{0.0F, -9.81F, 0.0F};
    float air_kg_m3 = 1.2F;
    wind::WindStyle wind{.speed_m_per_s = 0.0F};
    double ahead_m = 0.0;       ///< that it has blown farther than its speed times the time
    glm::dvec3 origin_m{0.0};   ///< of places, in the world
    float effort = 1.0F;        ///< see ClothStyle
    float rest_m_per_s = 5e-3F; ///< see ClothStyle::rest_mm_per_s
};

/// A triangle of a sheet as whoever draws it numbers it.
struct DrawnFace {
    uint32_t triangle = 0;
    glm::uvec3 vertices{0};
    glm::uvec3 particles{0};
};

/// The drawn vertices of a sheet.
struct DrawnSheet {
    uint32_t first_vertex = 0;
    std::vector<uint32_t> particle_of_vertex;  ///< from `first_vertex` on
    std::optional<uint32_t> first_back_vertex; ///< of the other side, if it has vertices of its own: as many,
                                               ///< in the same order
    std::vector<DrawnFace> faces;              ///< of a sheet that may tear
};

/// Of a drawn face: the bits of its sides in Cloths::torn().
struct BrittleFace {
    uint32_t triangle = 0;
    glm::uvec3 vertices{0};
    std::array<glm::uvec2, 3> sides{}; ///< particle and bit
};

/// Whether a side of it is torn. `torn` is what Cloths::torn() holds.
[[nodiscard]] bool is_torn(const BrittleFace& face, std::span<const glm::uvec2> torn);

/// A box that a sheet stays in.
struct SheetReach {
    glm::vec3 min_m{0.0F};
    glm::vec3 max_m{0.0F};
};

/// A box of air that a fluid moves, whose ends meet.
struct Flow {
    glm::uvec3 cells{0};
    glm::mat4 cells_from_place{1.0F}; ///< from the low corner; all axes alike
};

/// A mesh that moves as it likes, for what is seen of it along one axis.
struct Body {
    std::vector<glm::uvec3> triangles; ///< posed vertices
    glm::uvec2 nodes{2};               ///< of the grid that is seen through, along x and y of its solid
};

/// The same sheets and runs give the same places on the same device, bit for bit. A sheet that has been calm
/// for shared::cloth_rest_s, by all of its particles, rests: steps leave it as it is until wind blows,
/// something that holds it moves, a solid moves near it, it is carried, or the surroundings are others.
class Cloths {
public:
    /// Sheets lie still where they were cut. `drawn` is one a sheet, or empty. Throws Error as
    /// build_structure(), and where they do not fit the device.
    Cloths(gpu::Device& device, std::span<const Sheet> sheets, std::span<const DrawnSheet> drawn = {});

    /// Which solver takes all sheets, in place of their own; what they do goes on.
    void set_solver(gpu::Device& device, std::optional<ClothSolver> solver);

    /// Whether small sheets have as many threads as a GPU takes at once, if the device does; by default where
    /// it is one. Processors are quicker with fewer, and places are the same to a float's rounding.
    void set_wide(const gpu::Device& device, bool is_wide);

    /// Where solids are at the end of the next run; until then they go there from where they were, if there
    /// were as many. Later runs find them there.
    void set_solids(gpu::Device& device, std::span<const Solid> solids);

    /// What all sheets stay in during later runs, so that solids that come near none of it cost nothing;
    /// empty: they may come anywhere.
    void set_reach(std::vector<SheetReach> reach) { reach_ = std::move(reach); }

    /// What solids of heights and distances are told by, until the next call; before set_solids(). Cost: one
    /// upload.
    void set_grids(gpu::Device& device, std::span<const SolidGrid> grids);

    /// Bodies that solids of kind `seen` stand for, until the next call; before set_solids(). Cost: an upload
    /// of their triangles.
    void set_bodies(gpu::Device& device, std::span<const Body> bodies);

    /// Boxes in which later runs find the speeds that add_flow() last told, in place of the wind; where they
    /// overlap, those of the last. Throws std::logic_error for more than shared::cloth_most_flows.
    void set_flows(gpu::Device& device, std::span<const Flow> flows);

    /// Where particles are wanted at the end of the next run, if they are held, sheet by sheet. The same
    /// holds as of solids.
    void set_targets(gpu::Device& device, std::span<const glm::vec3> places_m);

    /// What the passes of a graph hand on to each other; once a graph, and before them.
    struct Handles {
        gpu::BufferId places;
        gpu::BufferId places_before;
        gpu::BufferId speeds;
        gpu::BufferId pushes;
        gpu::BufferId near;
        gpu::BufferId torn;
        gpu::BufferId solids;
        std::array<gpu::BufferId, 2> predicted;
        std::array<gpu::BufferId, 2> targets;
        std::array<gpu::BufferId, 2> seen;
    };

    [[nodiscard]] Handles import(gpu::Graph& graph);

    /// Tells how the air of a box moves: component by component on the low faces of cells, layer by layer, as
    /// `fluid` keeps it. Of each box once before the next run, one a
    /// graph.
    void add_flow(gpu::Graph& graph, size_t flow, gpu::ImageId velocity);

    /// set_targets() as a pass: the drawn vertices as they are posed.
    void add_targets(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices);

    /// Looks at the front and the back of all bodies, as they are posed at the end of the next run, from
    /// where set_solids() put them: until then they go there from what was seen last. Later runs find them
    /// so. Cost: two passes a body; a thread for each triangle goes over the nodes that it covers. Source:
    /// Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 7.5.
    void add_bodies(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices);

    /// Carries sheets as they stand, one matrix each: with what they hang on when that is put elsewhere. A
    /// matrix of zeros puts a sheet where its particles are wanted, at rest and whole.
    void add_carry(gpu::Graph& graph, Handles& handles, std::span<const glm::mat4> carries);

    /// A run of so many steps; one a graph. Throws std::logic_error for none, or more than most_steps().
    void add_steps(gpu::Graph& graph, Handles& handles, const Surroundings& surroundings, uint32_t count);

    /// As many as one graph takes, at least one.
    [[nodiscard]] uint32_t most_steps(const Surroundings& surroundings) const;

    /// The next targets and bodies hold for the beginning of their run too, and what the next run finds
    /// otherwise than the one before wakes nobody.
    void forget_before()
    {
        has_targets_ = false;
        has_seen_ = false;
        rouses_all_ = false;
        surroundings_.reset();
    }

    /// Keeps where sheets are, for add_vertices_before().
    void add_snapshot(gpu::Graph& graph, Handles& handles);

    /// Overwrites the drawn vertices' places and normals: as sheets are, or as they were at the last
    /// add_snapshot().
    [[nodiscard]] gpu::BufferId add_vertices(gpu::Graph& graph, const Handles& handles,
                                             gpu::BufferId posed_vertices);
    [[nodiscard]] gpu::BufferId add_vertices_before(gpu::Graph& graph, const Handles& handles,
                                                    gpu::BufferId posed_vertices);

    [[nodiscard]] uint32_t first_of(size_t sheet) const { return records_.at(sheet).first; }

    [[nodiscard]] uint32_t particle_count() const { return particle_count_; } ///< with those that fill up

    [[nodiscard]] size_t sheet_count() const { return records_.size(); }

    [[nodiscard]] bool may_tear() const { return may_tear_; }

    /// Which links of sheets that may tear are torn: two words a particle, see cloth_torn.glsl.
    [[nodiscard]] gpu::Buffer& torn() { return torn_; }

    /// Those of `drawn`, sheet by sheet.
    [[nodiscard]] std::span<const BrittleFace> brittle_faces() const { return brittle_faces_; }

    /// Places and inverse masses, speeds, and, where any may tear, torn(): all that the next run goes on
    /// from.
    [[nodiscard]] std::vector<gpu::Buffer*> state();

    /// Goes on from what state() of the same sheets was; buffers of the same sizes.
    void recall(std::vector<gpu::Buffer> state);

private:
    struct Kind;

    /// One step of large sheets, and the handles that its passes share.
    struct LargeStep {
        uint32_t number = 0;      ///< in the run
        uint32_t small_steps = 1; ///< or relaxations
        gpu::BufferId awake;
        gpu::BufferId began;
        gpu::BufferId met;
    };

    /// Method that moves large sheets through a step, from the places that cloth_push.comp predicts.
    struct Solver {
        uint32_t bits = 0;               ///< Bits of the shaders' variant
        bool takes_small_sheets = false; ///< Small sheets run in one dispatch of their own
        uint32_t sweeps = 0;             ///< Over all colours, per small step; divides the small steps
        uint32_t relaxations = 0;        ///< Of a whole step, per small step of the usual solver; 0: none
        bool lowers_rigidity = false;    ///< Lowers bending rigidity where a small step is too long for it
        void (Cloths::*add_step)(gpu::Graph&, Handles&, Kind&, const LargeStep&) = nullptr;
    };

    /// The only place that names the solvers.
    [[nodiscard]] static const Solver& solver_named(ClothSolver name);

    /// Sheets that one dispatch serves.
    struct Kind {
        const Solver* solver = nullptr;
        uint32_t variant = 0;
        bool is_small = false;
        uint32_t first_group = 0;
        uint32_t group_count = 0;
        uint32_t most_particles = 0;     ///< of a sheet
        std::optional<uint32_t> lone;    ///< the sheet, if it is large and there is one
        std::vector<glm::uvec2> colours; ///< for sweeps: first group of each and how many
        gpu::Buffer run;
    };

    void lay_out(gpu::Device& device, std::span<const Sheet> sheets, std::span<const DrawnSheet> drawn);
    void find_brittle_faces(const Structure& structure, const DrawnSheet& drawn);
    void lay_out_vertices(gpu::Device& device, std::span<const DrawnSheet> drawn);
    void group_sheets(gpu::Device& device);

    [[nodiscard]] const Solver& solver_of(size_t sheet) const
    {
        return solver_named(solver_.value_or(solvers_[sheet]));
    }

    [[nodiscard]] uint32_t variant_of(size_t sheet) const;
    [[nodiscard]] bool is_small(size_t sheet) const;
    void append_colours(Kind& kind, std::vector<uint32_t>& groups) const;
    /// Small steps that a step is cut into, or relaxations of a whole one.
    [[nodiscard]] uint32_t small_steps(const Kind& kind, const Surroundings& surroundings) const;
    [[nodiscard]] gpu::BufferId add_vertices_at(gpu::Graph& graph, const Handles& handles,
                                                gpu::BufferId places, gpu::BufferId posed_vertices);
    void find_met_solids();
    void lower_rigidities(const Surroundings& surroundings);
    void fill_runs(const Surroundings& surroundings, uint32_t count);
    void bind_common(gpu::Graph& graph, gpu::Pass& pass, const Handles& handles, gpu::Buffer& run,
                     gpu::Buffer& sheet_of_group, bool as_few_sheets = false);
    void add_small_sheets(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t count);
    void add_rest(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId& awake);
    void add_near(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId awake);
    void add_tears(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId awake);
    [[nodiscard]] uint64_t met_bytes(const Kind& kind) const;
    void add_large_sheets(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step,
                          uint32_t small_steps, gpu::BufferId& awake);
    /// One pass of a step, with a solver's own shader that includes cloth_large.glsl.
    void add_pass_of_step(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step,
                          std::string_view name, const gpu::Shader& shader, uint32_t small_step);
    void add_small_steps(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step);
    void add_small_step(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step,
                        uint32_t small_step);
    void add_descents(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step);
    void add_relaxations(gpu::Graph& graph, Handles& handles, Kind& kind, const LargeStep& step);

    std::vector<shared::ClothSheet> records_;
    std::vector<float> rigidities_n_m_;
    std::vector<float> bending_rates_s2_;
    std::vector<ClothSolver> solvers_;
    std::optional<ClothSolver> solver_;
    bool is_wide_ = false; ///< see set_wide()
    uint32_t particle_count_ = 0;
    std::vector<float> held_; ///< one a particle
    bool has_half_held_ = false;
    gpu::Buffer sheets_;
    gpu::Buffer links_;
    gpu::Buffer faces_;
    gpu::Buffer tethers_;
    gpu::Buffer rest_;      ///< places at rest
    gpu::Buffer near_;      ///< four particles each, of sheets that keep from themselves
    gpu::Buffer by_colour_; ///< particles of all sheets by colours, each padded to whole workgroups
    std::vector<std::vector<glm::uvec2>> colours_; ///< of each sheet: where each begins there, and its length
    gpu::Buffer holds_;                            ///< ClothHold, one a particle
    std::vector<shared::ClothCollider> solids_before_, solids_;
    std::vector<shared::ClothCollider> met_before_, met_; ///< of those, what the run may meet
    std::vector<SheetReach> reach_;
    bool rouses_all_ = false;                  ///< something has come or gone since the last run
    std::optional<Surroundings> surroundings_; ///< of the last run
    gpu::Buffer colliders_;
    std::vector<shared::ClothFlow> flows_;
    gpu::Buffer flow_speeds_;
    gpu::Buffer grids_; ///< numbers of all grids, each behind its head
    std::vector<uint32_t> first_of_grid_;
    std::array<gpu::Buffer, 2> targets_; ///< of the run's beginning and its end
    bool has_targets_ = true;
    bool targets_move_ = false;
    gpu::Buffer body_triangles_;
    std::vector<shared::ClothBody> bodies_; ///< but for where they are
    std::array<gpu::Buffer, 2> seen_;       ///< of all bodies, at the run's beginning and its end
    bool has_seen_ = false;
    bool bodies_move_ = false;
    gpu::Buffer places_;
    gpu::Buffer places_before_; ///< at the last snapshot
    gpu::Buffer speeds_;
    gpu::Buffer torn_;
    bool may_tear_ = false;
    std::vector<BrittleFace> brittle_faces_;
    gpu::Buffer pushes_;
    std::array<gpu::Buffer, 2> predicted_;
    std::vector<Kind> kinds_;
    gpu::Buffer sheet_of_group_; ///< of kinds_; all groups of all sheets come first
    uint32_t all_groups_ = 0;
    gpu::Buffer carries_;
    std::vector<Kind> vertex_kinds_;
    gpu::Buffer vertices_; ///< of vertex_kinds_, group by group
    gpu::Buffer sheet_of_vertex_group_;
};

} // namespace estampe::cloth
