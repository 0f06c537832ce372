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
};

/// Corners in clip space, reversed z with the near plane at z = w.
struct ClipTriangle {
    glm::vec4 corner[3];
    bool two_sided = true;
    bool mirrored = false;
};

/// Each pixel's hits, nearest first, under the rules that the renderer states: positions rounded to 1/256
/// pixel, top and left edges own the pixel centres on them, counter-clockwise is the front.
[[nodiscard]] std::vector<std::vector<PageHit>> raster_page(const std::vector<ClipTriangle>& triangles,
                                                            glm::uvec2 size_px);

} // namespace estampe::test
