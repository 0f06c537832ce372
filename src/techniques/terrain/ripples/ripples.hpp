// SPDX-License-Identifier: MIT
#pragma once

// Ripples on sand: small waves in the shading normals near the eye. The ripples fade out where they are finer
// than pixels.

#include <optional>

#include <estampe/terrain.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {

/// Computes the constants of the ripples relative to an anchor (a nearby origin), so that coordinates stay
/// small. `time_s` is the time in seconds, `draw` the number of the terrain's draw (mesh primitive). Returns
/// none if the terrain has no ripples.
[[nodiscard]] std::optional<shared::RippleConstants>
ripples_at(const TerrainDescription& terrain, uint32_t draw, const glm::dvec3& anchor_m, double time_s);

struct RippleInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal; ///< rg32ui: shading normal in the first channel, smooth normal in the second
    glm::uvec2 size_px{0};
};

/// Tilts the terrain's shading normals by the slope of ripples.
///
/// Writes  a new version of `normal`; the normals change at pixels of the terrain that are smaller on the
///         ground than 0.36 wavelengths
/// Cost    one full-screen dispatch
/// Source  Tricard et al., "Procedural Phasor Noise", SIGGRAPH 2019, with four waves per place, on a lattice
[[nodiscard]] gpu::ImageId add_ripples(gpu::Graph& graph, const RippleInputs& in,
                                       const shared::RippleConstants& ripples);

} // namespace estampe::terrain
