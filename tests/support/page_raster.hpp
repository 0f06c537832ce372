// SPDX-License-Identifier: MIT
#pragma once

// A rasteriser in the plainest form, for comparison: every pixel of the page against every triangle, in whole
// numbers.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::test {

struct PageHit {
    uint32_t triangle = 0;
    double depth = 0.0;     ///< reversed; 0 where nothing is seen
    double tolerance = 0.0; ///< what float arithmetic may make of the depth
    bool sure = true;       ///< false where the pixel's centre is nearer to an edge than the slack
};

/// Corners in clip space, reversed z with the near plane at z = w.
struct ClipTriangle {
    glm::vec4 corner[3];
    bool two_sided = true;
    bool mirrored = false;
};

/// Each pixel's hits, nearest first, under the rules that the renderer states: positions rounded to 1/256
/// pixel, top and left edges own the pixel centres on them, counter-clockwise is the front. A rasteriser
/// that may place edges differently by `slack`, in 1/256 pixel, gets the hits that it might see besides, and
/// so much tolerance for depth as that makes.
[[nodiscard]] std::vector<std::vector<PageHit>> raster_page(const std::vector<ClipTriangle>& triangles,
                                                            glm::uvec2 size_px, int64_t slack = 0);

} // namespace estampe::test
