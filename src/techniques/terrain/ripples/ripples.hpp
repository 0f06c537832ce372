// SPDX-License-Identifier: MIT
#pragma once

// Ripples on sand: they give tone near the eye, and vanish where they are finer than pixels.

#include <optional>

#include <estampe/terrain.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// The ripples relative to an anchor, at a time in seconds, so that lattice coordinates stay small. `draw` is
/// the terrain's draw. Returns none if the terrain has no ripples.
[[nodiscard]] std::optional<shared::RippleConstants>
ripples_at(const TerrainDescription& terrain, uint32_t draw, const glm::dvec3& anchor_m, double time_s);

struct RippleInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading normal, smooth normal
    glm::uvec2 size_px{0};
};

/// Bends the terrain's shading normals by ripples.
///
/// Writes  a new version of `normal`, for pixels of the terrain within some 300 pixels' worth of wavelengths
/// Cost    one full-screen dispatch
/// Source  Tricard et al., "Procedural Phasor Noise", SIGGRAPH 2019, with four waves per place, on a lattice
[[nodiscard]] gpu::ImageId add_ripples(gpu::Graph& graph, const RippleInputs& in,
                                       const shared::RippleConstants& ripples);

} // namespace estampe::terrain
