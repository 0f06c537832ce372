// SPDX-License-Identifier: MIT
#pragma once

// Differences between two pictures, in numbers and as a picture. The plain numbers count every changed pixel.
// The perceptual numbers count what a viewer at reading distance would see: a hatch line that moved by a
// fraction of a pixel counts less than a shift of tone over an area.

#include <cstdint>
#include <string>

#include <estampe/image.hpp>

namespace estampe::test {

/// An opaque picture of one grey.
[[nodiscard]] Image flat_image(uint32_t width, uint32_t height, uint8_t grey);

/// The difference of a pixel is the largest of its four channels' absolute differences, in steps of 1/255.
struct ImageDifference {
    uint32_t max_abs = 0;          ///< largest difference of any pixel, 0 to 255
    double mean_abs = 0.0;         ///< mean difference of all pixels, 0 to 255
    double failing_fraction = 0.0; ///< share of pixels whose difference exceeds the limit, 0 to 1
    double delta_e_mean =
        0.0; ///< CIE 1976 delta E after a blur of sigma 1 px in linear light; 2.3 is just noticeable
    double delta_e_p95 = 0.0; ///< 95th percentile of delta E
};

/// Compares two pictures of equal size. For the perceptual numbers, transparent pixels are composited over
/// white. `channel_limit` is the largest difference of a pixel that does not fail. Throws
/// std::invalid_argument when the sizes differ or a picture is empty. Cost: about 0.4 s per megapixel.
/// Source: CIE 15:2004, 8.2.1 (L*a*b*, delta E*ab); IEC 61966-2-1 (sRGB, D65).
[[nodiscard]] ImageDifference compare_images(const Image& expected, const Image& actual,
                                             uint32_t channel_limit = 2);

/// The five numbers in one line of text.
[[nodiscard]] std::string describe(const ImageDifference& difference);

/// One picture with 'expected | actual | difference' side by side. The difference is amplified four times, on
/// black. Where only one of the two has a pixel, the difference is magenta. Sizes may differ.
[[nodiscard]] Image difference_sheet(const Image& expected, const Image& actual);

/// A map of where two pictures of equal size differ: 9 lines of 16 characters. Each character shows the
/// largest difference in its cell, from ' ' (none) and '.' (1/255) to '@' (255/255). Throws as
/// compare_images.
[[nodiscard]] std::string heat_map(const Image& expected, const Image& actual);

} // namespace estampe::test
