// SPDX-License-Identifier: MIT
#pragma once

// Ink that flows from picture to picture: what it is in, and from where it was seen.

#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "features/ink/ink_water.hpp"
#include "techniques/ink/ink.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

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

    /// To be called when the first sample of that picture has been drawn.
    void drawn(const InkPlan& plan, const Camera& camera);

    /// Ink lies on the page: it is let go where what is under it is something else, or is found relative to
    /// another origin.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override { return FilmSection{"ink", 1}; }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    [[nodiscard]] ink::Memory& memory() { return memory_; }

    /// Of the water that ink stirs, when it last measured steps.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return water_.solver_report(); }

private:
    void forget();

    ink::Memory memory_;
    InkWater water_;
    Camera camera_before_;
};

} // namespace estampe::features
