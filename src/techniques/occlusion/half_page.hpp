// SPDX-License-Identifier: MIT
#pragma once

// Every second pixel of the page each way, and of what is drawn of it.

#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {

/// Pixel `i` is pixel 2 * (from_half + i) of the page: the same pixels of it whatever tile is drawn.
struct HalfPage {
    glm::uvec2 from_half{0};
    glm::uvec2 half_px{1};
};

[[nodiscard]] inline HalfPage half_page(const OcclusionInputs& in)
{
    const glm::uvec2 from_half = (in.from_px + 1U) / 2U;
    const glm::uvec2 last_half = (in.from_px + in.size_px - 1U) / 2U;
    return {.from_half = from_half, .half_px = glm::max(last_half + 1U, from_half + 1U) - from_half};
}

} // namespace estampe::occlusion
