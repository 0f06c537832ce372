// SPDX-License-Identifier: MIT
#pragma once

// How things move on the page from one picture to another.

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// How far what is seen at each pixel of a picture has moved on the page since another moment.
struct Motion {
    uint32_t width = 0;
    uint32_t height = 0;
    /// Row by row: pixels to the right; pixels down; the reversed depth that the point had then (near plane
    /// over distance, 0 for what is infinitely far); 1. All four are 0 where it lay behind the eye then, and
    /// had no place on the page. See-through surfaces have none: it is that of what is solid behind them.
    std::vector<glm::vec4> pixels;
};

/// Writes an OpenEXR picture in floats, R, G, B and A as above: what stood at p - (R, G) then is at p now.
/// Beside `path` first, then renamed. Throws Error when there is no motion in it or it cannot be written.
void save_motion(const Motion& motion, const std::filesystem::path& path);

} // namespace estampe
