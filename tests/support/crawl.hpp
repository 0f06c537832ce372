// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "support/drawing.hpp"

namespace estampe::test {

/// Share of the page where the light at a world position changes in half a step. For each pixel, `Lit` holds
/// the `share` of light that arrives and the visible `point` in world space. `later` drew `now`.
template <class Lit>
[[nodiscard]] double crawl(const Lit& before, const Lit& now, const Drawing& later)
{
    const glm::uvec2 size_px = later.size_px;
    size_t changed = 0;
    size_t seen = 0;
    const glm::dmat4 clip_from_anchor(later.globals.clip_from_anchor);
    for (size_t i = 0; i < before.share.size(); ++i) {
        const glm::dvec4 clip = clip_from_anchor * glm::dvec4(before.point[i] - later.layout.anchor, 1.0);
        const glm::dvec2 at = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(size_px);
        if (at.x < 0.0 || at.y < 0.0 || at.x >= size_px.x || at.y >= size_px.y) {
            continue;
        }
        const size_t there = static_cast<size_t>(at.y) * size_px.x + static_cast<size_t>(at.x);
        ++seen;
        // The shadow edge may pass between two pixels, so only light that no neighbouring pixel has counts as
        // changed.
        bool found = false;
        for (const int step : {0, -1, 1, -static_cast<int>(size_px.x), static_cast<int>(size_px.x)}) {
            const auto other = static_cast<size_t>(
                std::clamp(static_cast<int>(there) + step, 0, static_cast<int>(now.share.size()) - 1));
            found |= std::abs(now.share[other] - before.share[i]) < 0.5;
        }
        changed += found ? 0U : 1U;
    }
    return static_cast<double>(changed) / static_cast<double>(seen);
}

} // namespace estampe::test
