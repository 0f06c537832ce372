// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::shadow {

/// Fits a perspective view from the sun along the eye's direction to the shadows that the eye sees, so that
/// texels are small near the eye. The view changes whenever the eye moves or turns. Returns sun_view() if the
/// eye sees no shadow, or in parallel projection, where perspective gains nothing.
///
/// Cost    some ten thousand multiplications on the CPU
/// Source  Wimmer, Scherzer and Purgathofer, "Light Space Perspective Shadow Maps", EGSR 2004
[[nodiscard]] SunView warped_view(const SunMapScene& scene);

/// A single shadow map around the eye that reaches `reach_m` to each side, as in Zanuttini's thesis of 2008.
/// The shadow fades towards the map's edge. `view` covers all casters; `size` is the map's side in texels.
[[nodiscard]] inline Clipmap faded_map(const SunView& view, uint32_t size, float reach_m)
{
    return {
        .view = view, .finest_m = 2.0 * static_cast<double>(reach_m) / size, .size = size, .level_count = 1};
}

} // namespace estampe::shadow
