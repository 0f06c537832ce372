// SPDX-License-Identifier: MIT
#pragma once

// How far two pictures are apart, in numbers and for the eye. The plain figures see every changed pixel; the
// perceptual ones see what a viewer at reading distance would, so that a hatch line that moved by a fraction
// of a pixel weighs less than a shift of tone over an area.

#include <cstdint>
#include <string>

#include <estampe/image.hpp>

namespace estampe::test {

/// An opaque picture of one grey.
[[nodiscard]] Image flat_image(uint32_t width, uint32_t height, uint8_t grey);

/// The difference of a pixel is the largest of its four channels' absolute differences, in steps of 1/255.
struct ImageDifference {
    uint32_t max_abs = 0;          ///< of any pixel, 0 to 255
    double mean_abs = 0.0;         ///< over all pixels, 0 to 255
    double failing_fraction = 0.0; ///< pixels whose difference is above the limit, 0 to 1
    double delta_e_mean =
        0.0; ///< CIE 1976 delta E after a blur of sigma 1 px in linear light; 2.3 is just noticeable
    double delta_e_p95 = 0.0; ///< 95th percentile of the same
};

/// Compares two pictures of equal size; transparent pixels are laid over white for the perceptual figures.
/// `channel_limit` is the largest difference of a pixel that does not fail. Throws std::invalid_argument when
/// the sizes differ or a picture is empty. Cost: about 0.4 s a megapixel. Source: CIE 15:2004, 8.2.1 (L*a*b*,
/// delta E*ab); IEC 61966-2-1 (sRGB, D65).
[[nodiscard]] ImageDifference compare_images(const Image& expected, const Image& actual,
                                             uint32_t channel_limit = 2);

/// One line: the five figures.
[[nodiscard]] std::string describe(const ImageDifference& difference);

/// 'expected | actual | difference' in one picture. The difference is four times amplified, on black; where
/// only one of the two has a pixel it is magenta. Sizes may differ.
[[nodiscard]] Image difference_sheet(const Image& expected, const Image& actual);

/// Where two pictures of equal size differ: 9 lines of 16 characters, each the largest difference in its
/// cell, from ' ' (none) and '.' (1/255) to '@' (255/255). Throws as compare_images.
[[nodiscard]] std::string heat_map(const Image& expected, const Image& actual);

} // namespace estampe::test
