// SPDX-License-Identifier: MIT
#pragma once

// Simulates all cloth sheets on the GPU with few dispatches.

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

/// Conditions that act on all cloth sheets (wind, air, time step). The conditions may change between two runs
/// of simulation steps.
struct Surroundings {
    float step_s = 1.0F / 120.0F; ///< time step of the cloth simulation, at most a thirtieth of a second
    double time_s = 0.0;          ///< time at the beginning of the run; the wind depends on it
    glm::vec3 gravity_m_s2{0.0F, -9.81F, 0.0F};
    float air_kg_m3 = 1.2F;
    wind::WindStyle wind{.speed_m_per_s = 0.0F};
    double ahead_m = 0.0;       ///< distance that the wind has moved, in addition to its speed times the time
    glm::dvec3 origin_m{0.0};   ///< origin of cloth positions, in the scene's world coordinates
    float effort = 1.0F;        ///< factor on the number of small steps, see ClothStyle
    float rest_m_per_s = 5e-3F; ///< speed below which a particle is calm, see ClothStyle::rest_mm_per_s
};

/// A triangle of a cloth sheet, with vertex numbers of the drawn mesh.
struct DrawnFace {
    uint32_t triangle = 0;
    glm::uvec3 vertices{0};
    glm::uvec3 particles{0};
};

/// The vertices of the drawn mesh that show one cloth sheet.
struct DrawnSheet {
    uint32_t first_vertex = 0;
    std::vector<uint32_t> particle_of_vertex;  ///< for each drawn vertex from `first_vertex` on: its particle
    std::optional<uint32_t> first_back_vertex; ///< first vertex of the sheet's back, if the back has vertices
                                               ///< of its own, in the number and order of the front
    std::vector<DrawnFace> faces; ///< triangles of the drawn sheet; needed only for a sheet that may tear
};

/// For each side of a drawn face, the place of its torn bit in Cloths::torn().
struct BrittleFace {
    uint32_t triangle = 0;
    glm::uvec3 vertices{0};
    std::array<glm::uvec2, 3> sides{}; ///< for each side of the face: particle and bit number
};

/// Whether any side of the face is torn. `torn` is the downloaded content of Cloths::torn().
[[nodiscard]] bool is_torn(const BrittleFace& face, std::span<const glm::uvec2> torn);

/// A box that a cloth sheet does not leave.
struct SheetReach {
    glm::vec3 min_m{0.0F};
    glm::vec3 max_m{0.0F};
};

/// A box of air whose velocity comes from a periodic fluid simulation.
struct Flow {
    glm::uvec3 cells{0};
    /// Converts a place, relative to the box's low corner, to grid cells; equal scale on all axes.
    glm::mat4 cells_from_place{1.0F};
};

/// A deforming mesh that sheets collide with, through its front and back surfaces along one axis.
struct Body {
    std::vector<glm::uvec3> triangles; ///< triangles of the body, as indices of posed vertices
    glm::uvec2 nodes{2};               ///< nodes of the body's grid, along x and y of its solid
};

/// Cloth sheets on the GPU. Equal sheets and runs give bit-identical positions on one device. A sheet comes
/// to rest once all its particles have been calm for shared::cloth_rest_s. Steps do not change a resting
/// sheet until the sheet is moved or its surroundings change: wind, a holder of a particle, or a nearby
/// solid.
class Cloths {
public:
    /// Creates sheets in their rest shape, without motion. `drawn` has one entry per sheet, or is empty.
    /// Throws Error as build_structure() does, and if the sheets do not fit the device.
    Cloths(gpu::Device& device, std::span<const Sheet> sheets, std::span<const DrawnSheet> drawn = {});

    /// Selects one solver for all sheets. The motion of the sheets continues.
    void set_solver(gpu::Device& device, std::optional<ClothSolver> solver);

    /// Selects whether each small sheet gets as many threads as a GPU runs in parallel. The default is true
    /// on GPUs; CPU implementations of Vulkan are faster with fewer threads. Positions are equal up to
    /// rounding.
    void set_wide(const gpu::Device& device, bool is_wide);

    /// Sets the places of all solids at the end of the next run of simulation steps. During the run, solids
    /// move from their last places to the new places, if the number of solids is unchanged. Later runs of
    /// steps start with the solids at the new places.
    void set_solids(gpu::Device& device, std::span<const Solid> solids);

    /// Sets boxes that sheets do not leave during later runs, so that distant solids cost nothing. An empty
    /// list means that sheets may go anywhere.
    void set_reach(std::vector<SheetReach> reach) { reach_ = std::move(reach); }

    /// Uploads the grids of all solids of heights and distances. The grids stay valid until the next call.
    /// Call set_grids() before set_solids(). Cost: one upload.
    void set_grids(gpu::Device& device, std::span<const SolidGrid> grids);

    /// Uploads the bodies of all solids of kind `seen`. The bodies stay valid until the next call. Call
    /// set_bodies() before set_solids(). Cost: an upload of the bodies' triangles.
    void set_bodies(gpu::Device& device, std::span<const Body> bodies);

    /// Sets boxes of air with the velocities of the last add_flow(), which replace the wind in later runs.
    /// Where boxes overlap, the last box counts. Throws std::logic_error for more than
    /// shared::cloth_most_flows boxes.
    void set_flows(gpu::Device& device, std::span<const Flow> flows);

    /// Sets the targets of held particles at the end of the next run of simulation steps, sheet by sheet.
    /// During the run, held particles move from their last targets to the new targets.
    void set_targets(gpu::Device& device, std::span<const glm::vec3> places_m);

    /// Graph resources that the cloth passes of one graph share. Create one `Handles` per graph, before the
    /// passes.
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

    /// Adds a pass that copies the air velocity of one box. `velocity` is stored as `fluid` does: component
    /// by component on the low faces of cells, layer by layer. Call add_flow() for each box before the next
    /// run, and once per graph.
    void add_flow(gpu::Graph& graph, size_t flow, gpu::ImageId velocity);

    /// Adds a pass that sets the targets of held particles, like set_targets(), from the posed positions of
    /// the drawn vertices.
    void add_targets(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices);

    /// Adds passes that measure the front and the back of all bodies in the places of set_solids(). The
    /// bodies are posed as at the end of the next run of steps. During the run, each surface changes from its
    /// last measured form to the new form. Cost: two passes per body; a thread for each triangle visits the
    /// nodes that the triangle covers. Source: Zanuttini, "Recherches en rendu non réaliste temps réel",
    /// Université Paris 8, 2008, section 7.5.
    void add_bodies(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices);

    /// Adds a pass that moves whole sheets, by one matrix per sheet, for example when the object that holds a
    /// sheet is moved. A matrix of zeros resets a sheet: its particles go to their targets, without motion,
    /// and no link is torn.
    void add_carry(gpu::Graph& graph, Handles& handles, std::span<const glm::mat4> carries);

    /// Adds a run of `count` simulation steps, once per graph. Throws std::logic_error for no step, or for
    /// more than most_steps().
    void add_steps(gpu::Graph& graph, Handles& handles, const Surroundings& surroundings, uint32_t count);

    /// Largest number of simulation steps in one graph, at least one.
    [[nodiscard]] uint32_t most_steps(const Surroundings& surroundings) const;

    /// Makes the targets and bodies of the next run of steps valid from the run's beginning. So particles and
    /// bodies do not move from their places in the last run. Changes between the last and the next run wake
    /// no sheet.
    void forget_before()
    {
        has_targets_ = false;
        has_seen_ = false;
        rouses_all_ = false;
        surroundings_.reset();
    }

    /// Adds a copy of the sheets' positions, which add_vertices_before() reads.
    void add_snapshot(gpu::Graph& graph, Handles& handles);

    /// Overwrites positions and normals of the drawn vertices, with the current sheets or with the sheets of
    /// the last add_snapshot().
    [[nodiscard]] gpu::BufferId add_vertices(gpu::Graph& graph, const Handles& handles,
                                             gpu::BufferId posed_vertices);
    [[nodiscard]] gpu::BufferId add_vertices_before(gpu::Graph& graph, const Handles& handles,
                                                    gpu::BufferId posed_vertices);

    [[nodiscard]] uint32_t first_of(size_t sheet) const { return records_.at(sheet).first; }

    /// Number of particles of all sheets, including padding.
    [[nodiscard]] uint32_t particle_count() const { return particle_count_; }

    [[nodiscard]] size_t sheet_count() const { return records_.size(); }

    [[nodiscard]] bool may_tear() const { return may_tear_; }

    /// Torn links of sheets that may tear, two words per particle. See cloth_torn.glsl.
    [[nodiscard]] gpu::Buffer& torn() { return torn_; }

    /// Breakable faces of the sheets that were passed as `drawn`, sheet by sheet.
    [[nodiscard]] std::span<const BrittleFace> brittle_faces() const { return brittle_faces_; }

    /// The whole state from which the next run of steps continues: positions with inverse masses, velocities,
    /// and torn() if any sheet may tear.
    [[nodiscard]] std::vector<gpu::Buffer*> state();

    /// Replaces the state by an earlier state() of equal sheets; the buffers must have equal sizes.
    void recall(std::vector<gpu::Buffer> state);

private:
    struct Kind;

    /// One simulation step of large sheets, with the graph handles that its passes share.
    struct LargeStep {
        uint32_t number = 0;      ///< index of the step in the run
        uint32_t small_steps = 1; ///< number of small steps in the step, or of relaxations
        gpu::BufferId awake;
        gpu::BufferId began;
        gpu::BufferId met;
    };

    /// A method (solver) that moves large sheets through a step, from the positions that cloth_push.comp
    /// predicts.
    struct Solver {
        uint32_t bits = 0;               ///< bits that the solver adds to the shaders' `variant`
        bool takes_small_sheets = false; ///< the solver can run small sheets in a dispatch of their own
        uint32_t sweeps = 0; ///< sweeps over all sets of unlinked particles per small step; the number of
                             ///< small steps is divided by it
        uint32_t relaxations = 0;     ///< number of relaxations of a whole step, for each small step that the
                                      ///< default solver would take
        bool lowers_rigidity = false; ///< lowers bending rigidity where a small step is too long to be stable
        void (Cloths::*add_step)(gpu::Graph&, Handles&, Kind&, const LargeStep&) = nullptr;
    };

    /// Finds a cloth solver by name.
    [[nodiscard]] static const Solver& solver_named(ClothSolver name);

    /// A group of sheets that one dispatch processes.
    struct Kind {
        const Solver* solver = nullptr;
        uint32_t variant = 0;
        bool is_small = false;
        uint32_t first_group = 0;
        uint32_t group_count = 0;
        /// Number of particles of the largest sheet of the kind (small or large).
        uint32_t most_particles = 0;
        std::optional<uint32_t> lone;    ///< number of the sheet, if only one sheet exists and it is large
        std::vector<glm::uvec2> colours; ///< for sweeps over sets of unlinked particles: first workgroup of
                                         ///< each set, and number of workgroups
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
    /// Number of small steps per step, or number of relaxations of a whole step.
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
    /// Adds one pass of a cloth step, for a solver's shader that includes cloth_large.glsl.
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
    bool is_wide_ = false; ///< each small sheet gets many threads, see set_wide()
    uint32_t particle_count_ = 0;
    std::vector<float> held_; ///< strength of the hold, per particle: 0 free, 1 held
    bool has_half_held_ = false;
    gpu::Buffer sheets_;
    gpu::Buffer links_;
    gpu::Buffer faces_;
    gpu::Buffer tethers_;
    gpu::Buffer rest_;      ///< positions of all particles in the sheets' rest shapes
    gpu::Buffer near_;      ///< for self-collision: four particles that are near each particle
    gpu::Buffer by_colour_; ///< particles of all sheets by set of unlinked particles, each set padded to
                            ///< whole workgroups
    /// Per sheet and set of unlinked particles: first index in `by_colour_`, and count.
    std::vector<std::vector<glm::uvec2>> colours_;
    gpu::Buffer holds_; ///< holders of particles, one ClothHold per particle
    std::vector<shared::ClothCollider> solids_before_, solids_;
    /// Colliders that sheets may meet in the current run of steps.
    std::vector<shared::ClothCollider> met_before_, met_;
    std::vector<SheetReach> reach_;
    bool rouses_all_ = false;                  ///< a change since the last run wakes all sheets
    std::optional<Surroundings> surroundings_; ///< surroundings of the last run
    gpu::Buffer colliders_;
    std::vector<shared::ClothFlow> flows_;
    gpu::Buffer flow_speeds_;
    gpu::Buffer grids_; ///< numbers of all solids' grids; each grid starts with its head (nodes per axis,
                        ///< half the size)
    std::vector<uint32_t> first_of_grid_;
    std::array<gpu::Buffer, 2> targets_; ///< targets at the beginning and the end of a run of steps
    bool has_targets_ = true;
    bool targets_move_ = false;
    gpu::Buffer body_triangles_;
    std::vector<shared::ClothBody> bodies_; ///< deforming bodies, without their current places
    std::array<gpu::Buffer, 2> seen_; ///< bodies' surfaces at the beginning and the end of a run of steps
    bool has_seen_ = false;
    bool bodies_move_ = false;
    gpu::Buffer places_;
    gpu::Buffer places_before_; ///< particle positions at the last snapshot
    gpu::Buffer speeds_;
    gpu::Buffer torn_;
    bool may_tear_ = false;
    std::vector<BrittleFace> brittle_faces_;
    gpu::Buffer pushes_;
    std::array<gpu::Buffer, 2> predicted_;
    std::vector<Kind> kinds_;
    gpu::Buffer sheet_of_group_; ///< for each group of `kinds_`: its sheet; the groups of all sheets together
                                 ///< come first
    uint32_t all_groups_ = 0;
    gpu::Buffer carries_;
    std::vector<Kind> vertex_kinds_;
    gpu::Buffer vertices_; ///< drawn vertices of `vertex_kinds_`, group by group
    gpu::Buffer sheet_of_vertex_group_;
};

} // namespace estampe::cloth
