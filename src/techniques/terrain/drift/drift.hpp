// SPDX-License-Identifier: MIT
#pragma once

// Drifting sand: strokes for the sand that the wind blows off the crests of dunes.

#include <optional>

#include <estampe/terrain.hpp>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

struct DriftStyle {
    style::AutoToggle enabled = style::AutoToggle::automatic;
    float amount = 0.8F;
    float length_m = 5.0F;
    float lift_m = 1.8F;
    float width_mm = 0.22F;
    float reach_m = 150.0F;
    glm::vec3 ink = style::srgb(0x2a2320);
};

[[nodiscard]] const style::Table<DriftStyle>& drift_table();

/// The drift of a picture: the common constants of its streaks, and the field of heights that they read.
struct DriftPlan {
    shared::DriftConstants streaks;
    shared::TerrainField field; ///< `streaks.side` texels per side
};

struct DriftView {
    glm::dvec2 eye_m{0.0};
    glm::dvec2 anchor_m{0.0};
    double time_s = 0.0;
    float pixels_per_mm = 1.0F;
};

/// Plans the drift of a picture; none if no sand is drawn.
[[nodiscard]] std::optional<DriftPlan> drift_at(const TerrainWind& wind, const DriftStyle& style,
                                                const DriftView& view);

struct DriftInputs {
    gpu::BufferId frame;  ///< FrameGlobals
    gpu::ImageId heights; ///< r32f, heights of the plan's field
    gpu::ImageId depth;   ///< r32f: reversed, 0 where no surface is visible
    glm::uvec2 size_px{0};
};

/// Draws streaks over `lines`, a layer like that of contours: square root of linear colour, with coverage in
/// alpha.
///
/// Cost    one thread per possible streak (100,000), one full-screen dispatch
[[nodiscard]] gpu::ImageId add_drift(gpu::Graph& graph, const DriftInputs& in,
                                     const shared::DriftConstants& streaks, const glm::vec3& ink,
                                     gpu::ImageId lines);

} // namespace estampe::terrain
