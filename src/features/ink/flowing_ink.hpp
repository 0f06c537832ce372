// SPDX-License-Identifier: MIT
#pragma once

// Ink that flows from picture to picture: what it is in, and from where it was seen; what single objects
// have to do with it, which give it and which drive it; and the water on the page that it stirs, whose
// eddies carry it.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

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

/// One word a draw, 1 where the patterns between commas name its object or one that it hangs on; the blank
/// ground is named by none. Empty where the patterns name all there is, "*". Patterns that name nothing go
/// into `notes`.
[[nodiscard]] std::vector<uint32_t> ink_mask(const pose::MeshData& meshes, const Scene& scene,
                                             std::string_view patterns, std::vector<std::string>& notes);

/// Where objects stand on the page.
struct ZoneView {
    const Scene& scene;
    const ScenePose& pose;
    glm::dvec3 anchor{0.0};
    const shared::FrameGlobals& page;
};

/// Zones as `text` has them: "Fan*=blow:20, Well=give:1 turn:90 amount:0". A zone is as large as a ball of
/// one metre in the space of its node. What is behind the eye has none, nor have more than `most_ink_zones`.
/// Throws Error for words that mean nothing; patterns that name nothing go into `notes`.
[[nodiscard]] std::vector<shared::InkZone> ink_zones(const ZoneView& view, std::string_view text,
                                                     std::vector<std::string>& notes);

/// What of the water the next picture of a film takes from this one.
struct KeptWater {
    double time_s = 0.0;
    std::vector<float> velocity; ///< two numbers a cell
};

class InkWater {
public:
    InkWater();
    ~InkWater();
    InkWater(const InkWater&) = delete;
    InkWater& operator=(const InkWater&) = delete;

    /// Stirs for the time that passes for the ink, and tells the stream function after it as
    /// ink::add_stream() takes it. Water that is not that of `time.from_s` starts at rest, some seconds
    /// before. With `is_measured` solver_report() tells of it. Cost: a step of some 2,000 cells for each 24th
    /// of a second.
    [[nodiscard]] std::vector<float> stirred(gpu::Device& device, gpu::Executor& executor,
                                             const ink::InkStyle& style, const ink::Page& page,
                                             const ink::Time& time, const std::vector<shared::InkZone>& zones,
                                             bool is_measured = false);

    /// Of the last time that stirred() measured steps; none where it did not since.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return solver_report_; }

    void forget();

    [[nodiscard]] std::optional<KeptWater> kept(gpu::Device& device, gpu::Executor& executor);

    /// The next picture may go on from that, where its page is as large.
    void recall(KeptWater kept);

private:
    std::unique_ptr<fluid::Fluid> fluid_; ///< none until it is asked for
    std::optional<KeptWater> recalled_;
    std::optional<SolverReport> solver_report_;
    double time_s_ = 0.0;
};

/// What a picture's ink is planned from.
struct FlowingInkInputs {
    const Scene& scene; ///< posed
    const pose::MeshData& layout;
    const ScenePose& pose;
    const Camera& camera; ///< of the page
    const RenderSettings& settings;
    const StyleTables& style;
    float nearby_m = 1.0F;   ///< see FrameGlobals
    bool pose_moved = false; ///< vertices stand elsewhere than in the picture before
};

struct InkPlan {
    ink::Plan ink;
    std::optional<MotionPlan> motion; ///< where it follows what moves by itself
};

class FlowingInk final : public Feature {
public:
    /// When the ink was that the next picture goes on from; nothing where that starts afresh.
    [[nodiscard]] std::optional<double> before_s(const RenderSettings& settings,
                                                 const ink::InkStyle& style) const;

    /// Plans the ink of a picture and makes room for it; nothing where the style has none. Patterns that name
    /// nothing go into `notes`. Throws Error for a flow map or zones that cannot be read.
    [[nodiscard]] std::optional<InkPlan> ensure(gpu::Device& device, gpu::Executor& executor,
                                                const FlowingInkInputs& in, std::vector<std::string>& notes);

    /// The ink of `drawn`, a picture of another size that has just been drawn, on the page of this one.
    [[nodiscard]] InkPlan shown_on(gpu::Device& device, const InkPlan& drawn, const FlowingInkInputs& in);

    /// Has ink flow out of the layers of `in` in the first sample of a picture, and lays it on the page: an
    /// image as ink::add_layer() has it.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, const InkPlan& plan, const ink::Inputs& in,
                                      bool is_first, glm::uvec2 size_px);

    /// To be called when the first sample of that picture has been drawn.
    void drawn(const InkPlan& plan, const Camera& camera);

    /// Ink lies on the page: it is let go where what is under it is something else, or is found relative to
    /// another origin.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"ink", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Of the water that ink stirs, when it last measured steps.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return water_.solver_report(); }

private:
    void forget();

    ink::Memory memory_;
    InkWater water_;
    Camera camera_before_;
};

} // namespace estampe::features
