// SPDX-License-Identifier: MIT
#pragma once

// Motion vectors on the page: how far each point of a picture has moved on the page since another time.

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// Motion vectors of a picture: how far the surface at each pixel has moved on the page since
/// RenderSettings::motion_since.
struct Motion {
    uint32_t width = 0;
    uint32_t height = 0;
    /// One motion vector per pixel, row by row. x: pixels to the right; y: pixels down; z: reversed depth of
    /// the point at the other moment (near plane over distance, 0 at infinity); w: 1. The four values of a
    /// motion vector are 0 if the point was behind the camera at the other moment, because a point behind the
    /// camera has no place on the page. See-through surfaces have no motion vectors; their pixels hold the
    /// motion of the solid surface behind.
    std::vector<glm::vec4> pixels;
};

/// Writes an OpenEXR picture in 32-bit floats, with R, G, B and A for x, y, z and w of Motion::pixels. A
/// point of the picture that is now at the pixel position p was at p - (R, G) at the other moment, where R
/// and G are the red and green values of the pixel. The file is written beside `path` and renamed. Throws
/// Error if `motion` is empty or the file cannot be written.
void save_motion(const Motion& motion, const std::filesystem::path& path);

} // namespace estampe
