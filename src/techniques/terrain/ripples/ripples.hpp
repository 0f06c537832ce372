// SPDX-License-Identifier: MIT
#pragma once

// Ripples on sand: tone where the eye is near, nothing where they would be finer than pixels.

#include <optional>

#include <estampe/terrain.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// Ripples as seen from an anchor, at a time in seconds: what is left of their lattice there is small. `draw`
/// is the terrain's. Nothing where a terrain has none.
[[nodiscard]] std::optional<shared::RippleConstants>
ripples_at(const TerrainDescription& terrain, uint32_t draw, const glm::dvec3& anchor_m, double time_s);

struct RippleInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading, smooth
    glm::uvec2 size_px{0};
};

/// Bends the shading normals of the terrain.
///
/// Writes  a new version of `normal`: on pixels of the terrain within some 300 pixels' worth of wavelengths
/// Cost    one full-screen dispatch
/// Source  Tricard et al., "Procedural Phasor Noise", SIGGRAPH 2019, with four waves a place, on a lattice
[[nodiscard]] gpu::ImageId add_ripples(gpu::Graph& graph, const RippleInputs& in,
                                       const shared::RippleConstants& ripples);

} // namespace estampe::terrain
