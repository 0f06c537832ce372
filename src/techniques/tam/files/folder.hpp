// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

using estampe::PaintedMap;

/// As estampe::load_tonal_art_map(). Where levels are missing, see derive_levels.hpp.
[[nodiscard]] PaintedMap read_map(const std::filesystem::path& path);

/// As estampe::is_map_folder().
[[nodiscard]] bool is_folder_name(const std::filesystem::path& path);

/// As estampe::save_tonal_art_map().
void write_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Makes a map of images as they were painted: tones from light to dark, in each level 0 and any number of
/// coarser ones, those of one level as large. `darkness` is measured where it is empty. `where` is for
/// errors.
[[nodiscard]] PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                                      std::vector<float> darkness, const std::string& where);

} // namespace estampe::tam
