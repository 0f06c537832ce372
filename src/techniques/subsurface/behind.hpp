// SPDX-License-Identifier: MIT
#pragma once

// What lies behind thick see-through bodies, blurred by what it is seen through.

#include <vector>

#include "techniques/subsurface/subsurface.hpp"

namespace estampe::subsurface {

inline constexpr uint32_t inside_layers =
    4; ///< surfaces of bodies that count: two bodies, one behind another

struct BehindInputs {
    SubsurfaceInputs common;
    gpu::BufferId visibility;          ///< of all that is solid
    std::vector<gpu::BufferId> inside; ///< of clear bodies alone, `inside_layers` at most, the nearest first
    gpu::BufferId background;          ///< visibility of all that is solid but them
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::ImageId color;   ///< rgba8: of what is seen, square root of linear
    gpu::ImageId painted; ///< rgba16f: paint of the background
};

/// Lays what lies behind into `wash`, where clear bodies are seen, and returns its new version. The way
/// through all bodies is summed up, colour by the law of Beer and Lambert and blur by thickness; then the
/// background is blurred once, by that sum.
///
/// Cost    a dispatch over all, one for each halving of the background, and one over all that reads 16 texels
///         a pixel of a body
/// Source  Zanuttini, "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 8.5
[[nodiscard]] gpu::ImageId add_behind(gpu::Graph& graph, const BehindInputs& in, gpu::ImageId wash);

} // namespace estampe::subsurface
