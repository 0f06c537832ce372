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

/// Constants of the drifting sand of one picture: constants of all streaks, and the field of heights from
/// which the streaks find crests.
struct DriftPlan {
    shared::DriftConstants streaks;
    shared::TerrainField field; ///< field of heights with `streaks.side` texels per side
};

struct DriftView {
    glm::dvec2 eye_m{0.0};
    glm::dvec2 anchor_m{0.0};
    double time_s = 0.0;
    float pixels_per_mm = 1.0F;
};

/// Computes the constants of the drifting sand. Returns none if no sand drifts.
[[nodiscard]] std::optional<DriftPlan> drift_at(const TerrainWind& wind, const DriftStyle& style,
                                                const DriftView& view);

struct DriftInputs {
    gpu::BufferId frame;  ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId heights; ///< r32f: height of the ground, on the field of the drifting sand's constants
    gpu::ImageId depth;   ///< r32f: reversed depth (1 at the near plane), 0 where no surface is visible
    glm::uvec2 size_px{0};
};

/// Draws streaks of drifting sand over the ink layer `lines` (square root of linear colour, with coverage in
/// alpha).
///
/// Cost    one thread per possible streak (100,000), one full-screen dispatch
[[nodiscard]] gpu::ImageId add_drift(gpu::Graph& graph, const DriftInputs& in,
                                     const shared::DriftConstants& streaks, const glm::vec3& ink,
                                     gpu::ImageId lines);

} // namespace estampe::terrain
