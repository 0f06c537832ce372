// SPDX-License-Identifier: MIT
#pragma once

// Flowing ink over several pictures. The file declares the state of the ink and the camera of the last
// picture, and the objects that emit or move ink. It also declares the simulated water on the page, which
// carries the ink.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "features/common/blast.hpp"
#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "gpu/graph/execute.hpp"
#include "shaders/frame.glsl.h"
#include "techniques/ink/ink.glsl.h"
#include "techniques/ink/ink.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::fluid {
class Fluid;
} // namespace estampe::fluid

namespace estampe::features {

/// Selects the draw calls that emit ink. One value per draw call: 1 if a comma-separated pattern matches the
/// draw call's node or an ancestor of the node. The blank ground never matches. Returns an empty list for
/// "*", which means every draw call. Patterns that match nothing are reported in `notes`.
[[nodiscard]] std::vector<uint32_t> ink_mask(const pose::MeshData& meshes, const Scene& scene,
                                             std::string_view patterns, std::vector<std::string>& notes);

/// The state of the ink's water at the end of a picture, for the next picture of a film.
struct KeptWater {
    double time_s = 0.0;
    std::vector<float> velocity; ///< Velocity of the water, two numbers per cell
    std::vector<float> mass;     ///< Mass of the water per cell if ink.solver is mass; else empty
};

class InkWater {
public:
    InkWater();
    ~InkWater();
    InkWater(const InkWater&) = delete;
    InkWater& operator=(const InkWater&) = delete;

    /// Simulates the water over the ink's time step, and returns the resulting stream function for
    /// ink::add_stream(). If there is no state of the water at the time `time.from_s`, the water starts from
    /// rest some seconds earlier. If `is_measured`, solver_report() is filled. Cost: one step of about 2,000
    /// cells per 24th of a second.
    [[nodiscard]] std::vector<float> stirred(gpu::Device& device, gpu::Executor& executor,
                                             const ink::InkStyle& style, const ink::Page& page,
                                             const ink::Time& time, const std::vector<shared::InkZone>& zones,
                                             bool is_measured = false);

    /// Returns the report of the last measured simulation steps; none if the last steps were not measured.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return solver_report_; }

    void forget();

    [[nodiscard]] std::optional<KeptWater> kept(gpu::Device& device, gpu::Executor& executor);

    /// Sets the state of the water from which the next picture continues, if its page has the same size.
    void recall(KeptWater kept);

private:
    std::unique_ptr<fluid::Fluid> fluid_; ///< Simulation of the water; made when it is first used
    std::optional<KeptWater> recalled_;
    std::optional<SolverReport> solver_report_;
    double time_s_ = 0.0;
};

/// The inputs for the flowing ink of a picture.
struct FlowingInkInputs {
    const Scene& scene; ///< Scene in the pose of the picture
    const pose::MeshData& layout;
    const ScenePose& pose;
    const Camera& camera; ///< Camera of the whole page
    const RenderSettings& settings;
    const StyleTables& style;
    float nearby_m = 1.0F;          ///< Distance from the eye to nearby objects, see FrameGlobals::nearby_m
    bool pose_moved = false;        ///< The scene's vertices moved since the previous picture
    std::vector<Blast> blasts = {}; ///< Blasts that push the ink away on the page
};

struct InkPlan {
    ink::Plan ink;
    /// Motion of the scene's objects; only set if ink moves along with the objects.
    std::optional<MotionPlan> motion;
};

class FlowingInk final : public Feature {
public:
    /// Returns the time of the ink at the end of the last picture; none if the ink starts from nothing.
    [[nodiscard]] std::optional<double> before_s(const RenderSettings& settings,
                                                 const ink::InkStyle& style) const;

    /// Plans the ink of a picture and allocates its buffers; none if the style has no ink. Patterns that
    /// match nothing are reported in `notes`. Throws Error if a flow map or a zone cannot be read.
    [[nodiscard]] std::optional<InkPlan> ensure(gpu::Device& device, gpu::Executor& executor,
                                                const FlowingInkInputs& in, std::vector<std::string>& notes);

    /// Returns a plan that shows the ink of `drawn` on this picture's page. `drawn` is the plan of a picture
    /// of another size that was just drawn.
    [[nodiscard]] InkPlan shown_on(gpu::Device& device, const InkPlan& drawn, const FlowingInkInputs& in);

    /// Advances the ink from the drawn layers of `in` in the first sample of a picture, and returns the
    /// page's ink as an image, as ink::add_layer() does.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const InkPlan& plan, const ink::Inputs& in,
                                      bool is_first, glm::uvec2 size_px);

    /// Records that the ink was drawn. Must be called when the first sample of the planned picture has been
    /// drawn.
    void drawn(const InkPlan& plan, const Camera& camera);

    /// Forgets the ink when the scene is replaced, or when positions get another origin.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"ink", 3}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Returns the report of the water's pressure solver, from the last measured steps.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return water_.solver_report(); }

private:
    void forget();

    ink::Memory memory_;
    InkWater water_;
    Camera camera_before_;
};

} // namespace estampe::features
