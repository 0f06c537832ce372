// SPDX-License-Identifier: MIT
#pragma once

#include "shaders/frame.glsl.h"
#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::shadow {

/// Where there is something to warp the map for.
struct WarpedScene {
    Bounds casters; ///< world space
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< unit vector
    double floor_m = 0.0;                  ///< nothing that is lit lies lower, world space
    double nearest_m = 0.0;                ///< about how far from the eye what is seen begins
};

/// A view of the sun over what `eye` sees of the casters' shadows, in perspective along the eye's direction,
/// so that texels are small near the eye. It is another one whenever the eye moves or turns. Where the eye
/// sees no shadow, or in parallel projection, nothing is gained: sun_view().
///
/// Cost    some ten thousand products on the processor
/// Source  Wimmer, Scherzer and Purgathofer, "Light Space Perspective Shadow Maps", EGSR 2004
[[nodiscard]] SunView warped_view(const WarpedScene& scene, const shared::FrameGlobals& eye, uint32_t size);

} // namespace estampe::shadow
