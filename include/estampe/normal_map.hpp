// SPDX-License-Identifier: MIT
#pragma once

// Tangent-space normal maps made from pictures of heights, for the normal textures of materials.

#include <cstdint>
#include <filesystem>
#include <vector>

#include <estampe/image.hpp>

namespace estampe {

/// Heights of a surface: rows from top to bottom, 0 lowest and 1 highest.
struct HeightMap {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> heights; ///< Heights of the surface from 0 to 1, width * height numbers
    /// Number of steps between height 0 and height 1 that the file can store, such as 255 for 8 bits.
    uint32_t steps = 255;
};

/// Largest NormalMapSettings::relief.
inline constexpr double most_relief = 10.0;

struct NormalMapSettings {
    double relief = 0.05; ///< Difference between the heights 0 and 1, as a share of the picture's width
    /// The picture tiles: its left edge continues at the right edge, and its top at the bottom.
    bool wraps = true;
    /// The green channel points down as in Direct3D, not up as in glTF and OpenGL.
    bool is_green_down = false;
};

/// Reads the heights of a picture from its brightness: the stored values of red, green and blue, weighted by
/// ITU-R BT.709 without conversion from sRGB. Alpha is ignored. A PNG with 16 bits per channel is read at
/// full precision. Other pictures are read by load_image(). Throws Error as load_image() does.
[[nodiscard]] HeightMap load_height_map(const std::filesystem::path& path);

/// Makes a normal map: computes the normal at each texel from the slopes of the heights. Red is x, to the
/// right; green is y; blue is z, out of the surface; each component from -1 to 1 is stored as 0 to 255. Alpha
/// is 255. Throws Error if the heights are empty or their number is wrong, or if the relief is not from 0 to
/// `most_relief`. Cost: linear in texels.
///
/// Source  derivatives by the filter of Scharr, "Optimale Operatoren in der digitalen Bildverarbeitung", 2000
[[nodiscard]] Image make_normal_map(const HeightMap& map, const NormalMapSettings& settings = {});

/// Returns the difference between two neighbouring height values that the file can store, in texels of the
/// picture's width. Above about 0.25 texels the normal map shows terraces. A picture with 16 bits per
/// channel, or a smaller relief, avoids the terraces.
[[nodiscard]] double height_step_texels(const HeightMap& map, const NormalMapSettings& settings);

} // namespace estampe
