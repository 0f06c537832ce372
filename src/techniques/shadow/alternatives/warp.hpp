// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::shadow {

/// A view of the sun over what the eye sees of the casters' shadows, in perspective along the eye's
/// direction, so that texels are small near the eye. It is another one whenever the eye moves or turns. Where
/// the eye sees no shadow, or in parallel projection, nothing is gained: sun_view().
///
/// Cost    some ten thousand products on the processor
/// Source  Wimmer, Scherzer and Purgathofer, "Light Space Perspective Shadow Maps", EGSR 2004
[[nodiscard]] SunView warped_view(const SunMapScene& scene);

/// The single map of the thesis: one level about the eye, `reach_m` to each side, towards whose edge shadow
/// pales. `view` is of all casters, `size` the level's.
[[nodiscard]] inline Clipmap faded_map(const SunView& view, uint32_t size, float reach_m)
{
    return {
        .view = view, .finest_m = 2.0 * static_cast<double>(reach_m) / size, .size = size, .level_count = 1};
}

} // namespace estampe::shadow
