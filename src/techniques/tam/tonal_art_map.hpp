// SPDX-License-Identifier: MIT
#pragma once

// Tonal art maps: what is asked of one, its levels and thresholds, and all its images on one sheet.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/image.hpp>
#include <estampe/tonal_art_map.hpp>

namespace estampe::tam {

using estampe::Gray8;
using estampe::TonalArtMap;

inline constexpr uint32_t min_size_px = 32;
inline constexpr uint32_t max_size_px = 2048;
inline constexpr size_t min_tones = 1;
inline constexpr size_t max_tones = 16;
/// Levels below this are averages of this one: a stroke there would be as wide as the map.
inline constexpr uint32_t least_drawn_px = 8;

/// Levels of a chain from `size_px` down to 1 px.
[[nodiscard]] size_t level_count(uint32_t size_px);

/// Mean coverage of an image, 0 to 1.
[[nodiscard]] double mean_coverage(const Gray8& image);

/// The mean of each square of four texels. `size_px` is that of `image`, and even.
[[nodiscard]] Gray8 half_size(const Gray8& image, uint32_t size_px);

/// Throws Error naming `where` unless sizes, number of images and darknesses are as TonalArtMap says.
void check_map(const TonalArtMap& map, const std::string& where);

/// One threshold image a level: the darkness, times 255, at which the texel turns to ink, so that a shader
/// draws any darkness t as saturate((t - T) * sharpness + 0.5), strokes whole, their order that of the map.
///
/// Those of the maker where the map has them: a share t of the texels has T <= 255 t, so that the tone is
/// exact. Else the coverage is taken to grow in a straight line from each tone to the next, from paper at 0
/// to ink at 1, and T is where it passes one half.
///
/// Source  Webb et al., "Fine Tone Control in Hardware Hatching", NPAR 2002
[[nodiscard]] std::vector<Gray8> threshold_levels(const TonalArtMap& map);

/// The thresholds of one level, from its tones alone.
[[nodiscard]] Gray8 interpolated_thresholds(const TonalArtMap& map, size_t level);

/// All images of a map on one sheet: a column a tone, the lightest at the left; in each the finest level on
/// top and the coarser ones below it, from left to right. Colours are linear.
[[nodiscard]] Image preview_sheet(const TonalArtMap& map, const glm::vec3& paper, const glm::vec3& ink);

} // namespace estampe::tam
