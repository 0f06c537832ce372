// SPDX-License-Identifier: MIT
#pragma once

// A rasteriser in the simplest form, for comparison: tests every pixel of the page against every triangle, in
// integers.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::test {

struct PageHit {
    uint32_t triangle = 0;
    double depth = 0.0;     ///< reversed; 0 for the background
    double tolerance = 0.0; ///< largest error of the depth in float arithmetic
    bool sure = true;       ///< false if the pixel's centre is nearer to an edge than `slack`
};

/// Corners in clip space, reversed z with the near plane at z = w.
struct ClipTriangle {
    glm::vec4 corner[3];
    bool two_sided = true;
    bool mirrored = false;
};

/// The hits of each pixel, nearest first, by the renderer's rules: positions are rounded to 1/256 pixel, top
/// and left edges own the pixel centres on them, and counter-clockwise triangles are front faces. If a
/// rasteriser may place edges differently by `slack`, in 1/256 pixel, the result also contains the additional
/// hits that it may find, and a larger depth tolerance.
[[nodiscard]] std::vector<std::vector<PageHit>> raster_page(const std::vector<ClipTriangle>& triangles,
                                                            glm::uvec2 size_px, int64_t slack = 0);

} // namespace estampe::test
