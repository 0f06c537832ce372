// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::shadow {

/// A perspective view from the sun along the eye's direction, fitted to the part of the shadows that the eye
/// sees, so that texels are small near the eye. The view changes whenever the eye moves or turns. Returns
/// sun_view() if the eye sees no shadow, or in parallel projection, where perspective gains nothing.
///
/// Cost    some ten thousand multiplications on the CPU
/// Source  Wimmer, Scherzer and Purgathofer, "Light Space Perspective Shadow Maps", EGSR 2004
[[nodiscard]] SunView warped_view(const SunMapScene& scene);

/// The single map of the thesis: one clipmap level around the eye, `reach_m` to each side. The shadow fades
/// towards the level's edge. `view` covers all casters; `size` is the level's side in texels.
[[nodiscard]] inline Clipmap faded_map(const SunView& view, uint32_t size, float reach_m)
{
    return {
        .view = view, .finest_m = 2.0 * static_cast<double>(reach_m) / size, .size = size, .level_count = 1};
}

} // namespace estampe::shadow
