// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// A map from elsewhere, and what had to be mended in it, a line each.
struct PaintedMap {
    TonalArtMap map;
    std::vector<std::string> warnings;
};

/// Reads what an artist painted: a folder of PNG files (a tone each, or a tone and level each), a folder of
/// DDS files (a tone each), one DDS file, or a .tam file. See the README for names and rules. Levels that are
/// missing are derived, see derive_levels.hpp; ink that a tone lacks of a lighter one is added and warned of.
///
/// Throws Error naming the file when there is none, or it is damaged, of a wrong size or out of order.
[[nodiscard]] PaintedMap read_map(const std::filesystem::path& path);

/// Whether write_map() would make a folder of that name: it ends in a slash, is a folder, or has no
/// extension.
[[nodiscard]] bool is_folder_name(const std::filesystem::path& path);

/// Writes a map as `path` ends: .tam, .dds, or else a folder of PNG files with `tam.toml` beside them. All of
/// it appears at once; a folder must not exist, or be empty. Throws Error.
void write_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Makes a map of images as they were painted: tones from light to dark, in each level 0 and any number of
/// coarser ones, those of one level as large. `darkness` is measured where it is empty. `where` is for
/// errors.
[[nodiscard]] PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                                      std::vector<float> darkness, const std::string& where);

} // namespace estampe::tam
