// SPDX-License-Identifier: MIT
#pragma once

// Checks tonal art maps, computes their levels and thresholds, and makes a preview of all images.

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
/// Side in pixels of the smallest mip level that is drawn with strokes. Smaller levels are averages of the
/// smallest drawn level, because a stroke would be as wide as the whole level.
inline constexpr uint32_t least_drawn_px = 8;

/// Number of mip levels from `size_px` down to 1 px.
[[nodiscard]] size_t level_count(uint32_t size_px);

/// Mean coverage of an image, 0 to 1.
[[nodiscard]] double mean_coverage(const Gray8& image);

/// Halves the size of an image: each texel is the mean of a square of four texels. `size_px`, the size of
/// `image`, must be even.
[[nodiscard]] Gray8 half_size(const Gray8& image, uint32_t size_px);

/// Throws Error naming `where` unless the map's sizes, number of images and darknesses satisfy the rules of
/// TonalArtMap.
void check_map(const TonalArtMap& map, const std::string& where);

/// Returns one threshold image per level. The threshold T of a texel is the darkness, times 255, at which the
/// texel turns to ink. To draw any darkness t, a shader computes the ink of a texel as
/// saturate(sharpness * (t - T / 255) + 0.5). So whole strokes appear in the order of the map.
///
/// Uses the maker's thresholds if the map has them. With the maker's thresholds, the share of texels that are
/// ink equals the darkness, so the tone is exact. Otherwise each texel's coverage is interpolated linearly
/// from tone to tone, from paper at darkness 0 to ink at darkness 1. The threshold divided by 255 is the
/// darkness at which the coverage passes one half.
///
/// Source  Webb et al., "Fine Tone Control in Hardware Hatching", NPAR 2002
[[nodiscard]] std::vector<Gray8> threshold_levels(const TonalArtMap& map);

/// Computes the thresholds of one level by interpolation between its tones.
[[nodiscard]] Gray8 interpolated_thresholds(const TonalArtMap& map, size_t level);

/// Puts all images of a map on one sheet: one column per tone, the lightest tone at the left. The finest
/// level is on top. The coarser levels are below it, from left to right. Colours are linear.
[[nodiscard]] Image preview_sheet(const TonalArtMap& map, const glm::vec3& paper, const glm::vec3& ink);

} // namespace estampe::tam
