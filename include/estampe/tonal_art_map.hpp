// SPDX-License-Identifier: MIT
#pragma once

// Strokes drawn ahead, as pictures: what a style hatches with when it says `hatch.strokes=map`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/style.hpp>

namespace estampe {

/// Coverage of one level, a square of 8-bit texels row by row from the top: 0 paper, 255 ink.
using Gray8 = std::vector<uint8_t>;

/// Nested strokes for several darknesses and every mip level. What is ink in a tone is ink in all darker
/// ones, and a stroke of a level is there, as many pixels wide, in all finer ones. Wraps without a seam.
///
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
struct TonalArtMap {
    uint32_t size_px = 0;                          ///< of level 0; a power of two, 32 to 2048
    std::vector<float> darkness;                   ///< mean coverage wanted of each tone, rising, in (0, 1)
    std::vector<std::vector<Gray8>> level_of_tone; ///< [tone][level]: level 0 of size_px, the last of 1 px

    /// By level, the darkness, times 255, at which each texel turns to ink, where the maker knows the order
    /// of the strokes within a tone; empty for maps that were painted.
    std::vector<Gray8> threshold_of_level;

    bool operator==(const TonalArtMap&) const = default;
};

/// A map from elsewhere, and what had to be mended in it, a line each.
struct PaintedMap {
    TonalArtMap map;
    std::vector<std::string> warnings;
};

/// Draws a map as the style's [tam] says; no device is needed. Where there is a picture of one `stroke`, from
/// its left side to its right, its alpha is the ink of all of them, or its darkness if it is opaque. The same
/// style and picture give the same bytes. Throws Error when the style asks for what cannot be, or the picture
/// has no ink.
///
/// Cost    a second for 512 px and 6 tones, on one core
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
[[nodiscard]] TonalArtMap draw_tonal_art_map(const Style& style, const Image* stroke = nullptr);

/// Reads what an artist painted: a folder of PNG files (a tone each, or a tone and level each), a folder of
/// DDS files (a tone each), one DDS file, or a .tam file; src/techniques/tam/README.md has names and rules.
/// Levels that are missing are derived; ink that a tone lacks of a lighter one is added and warned of. Throws
/// Error naming the file when there is none, or it is damaged, of a wrong size or out of order.
[[nodiscard]] PaintedMap load_tonal_art_map(const std::filesystem::path& path);

/// Writes a map as `path` ends: .tam, .dds, or else, with a slash or no extension at the end, a folder of PNG
/// files that can be painted over, with `tam.toml` beside them. All of it appears at once; a folder must not
/// exist, or be empty. Throws Error when that cannot be, or the map is not sound.
void save_tonal_art_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Whether save_tonal_art_map() would make a folder of that name: it ends in a slash, is a folder, or has no
/// extension.
[[nodiscard]] bool is_map_folder(const std::filesystem::path& path);

/// All images of a map on one sheet, in ink and paper of the style: a column a tone, the lightest at the
/// left; in each the finest level on top and the coarser ones below it, from left to right. Throws Error when
/// the map is not sound.
[[nodiscard]] Image map_sheet(const TonalArtMap& map, const Style& style);

} // namespace estampe
