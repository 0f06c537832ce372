// SPDX-License-Identifier: MIT
#pragma once

// Tonal art maps: precomputed textures of strokes. A style hatches with tonal art maps if it sets
// `hatch.strokes=map`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/read_scope.hpp>
#include <estampe/style.hpp>

namespace estampe {

/// Coverage of one mip level: a square of 8-bit texels, row by row from the top; 0 is paper, 255 is ink.
using Gray8 = std::vector<uint8_t>;

/// Nested stroke textures for several tones and all mip levels. The ink of a tone is also in all darker
/// tones, and a stroke of a level is also in all finer levels, with the same width in pixels. Textures tile
/// without a seam.
///
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
struct TonalArtMap {
    uint32_t size_px = 0;        ///< Texels per side of level 0; a power of two, 32 to 2048
    std::vector<float> darkness; ///< Intended mean coverage of each tone from light to dark, each in (0, 1)
    /// Texels of each tone and mip level, as [tone][level]: level 0 has size_px texels per side, the last
    /// level has 1.
    std::vector<std::vector<Gray8>> level_of_tone;

    /// For each mip level and texel: the darkness, times 255, from which the texel is ink. Empty if the order
    /// of the strokes within a tone is not known, as for painted maps.
    std::vector<Gray8> threshold_of_level;

    bool operator==(const TonalArtMap&) const = default;
};

/// A tonal art map that was read from files, with one line of warning for each defect that was repaired.
struct PaintedMap {
    TonalArtMap map;
    std::vector<std::string> warnings;
};

/// Draws a tonal art map with the settings of the style's section [tam]; no device is required. `stroke` is a
/// picture of one stroke, from left to right: the picture's alpha is the ink of every stroke, or the
/// picture's darkness if it is opaque. The same style and picture give the same bytes. Throws Error if no map
/// can be drawn with the style's values or the picture has no ink.
///
/// Cost    1 s for 512 px and 6 tones, on one core
/// Source  Praun et al., "Real-Time Hatching", SIGGRAPH 2001
[[nodiscard]] TonalArtMap draw_tonal_art_map(const Style& style, const Image* stroke = nullptr);

/// Reads a painted tonal art map: a folder of PNG files (one per tone, or one per tone and level), a folder
/// of DDS files (one per tone), one DDS file, or a .tam file. src/techniques/tam/README.md has names and
/// rules. Missing levels are derived. Ink of a lighter tone that a darker tone lacks is added, with a
/// warning. Throws Error that names the file if nothing is found, or if a file is damaged, of the wrong size
/// or out of order,
/// and if a file lies outside of `scope`.
[[nodiscard]] PaintedMap load_tonal_art_map(const std::filesystem::path& path, const ReadScope& scope = {});

/// Writes a tonal art map. The extension of `path` chooses the format: .tam, .dds, or or, with a trailing
/// slash or no extension, a folder of PNG files that can be painted over. The folder also gets a file
/// `tam.toml`. The result appears only when it is complete. An existing folder must be empty. Throws Error if
/// the map is not valid or cannot be written.
void save_tonal_art_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Returns whether save_tonal_art_map() would write a folder: `path` ends in a slash, is a folder, or has no
/// extension.
[[nodiscard]] bool is_map_folder(const std::filesystem::path& path);

/// Draws a contact sheet of all images of a tonal art map, in the style's ink and paper colours: one column
/// per tone, the lightest at the left; the finest mip level on top, and the coarser ones below it from left
/// to right. Throws Error if the map is not valid.
[[nodiscard]] Image map_sheet(const TonalArtMap& map, const Style& style);

} // namespace estampe
