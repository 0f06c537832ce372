// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <png.h>

namespace estampe {

/// What a PNG file says ahead of its pixels.
struct PngHead {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;
    uint32_t bits = 8;
    uint32_t dots_per_m = 0; ///< 0: nothing is said
};

/// Of deflate: as fast as 3 on drawings, which it makes smaller.
inline constexpr int png_level = 4;

/// Writes that, of sRGB, and sets compression for speed rather than size. May jump, see CodecFailure.
inline void png_write_head(png_structp png, png_infop info, const PngHead& head)
{
    png_set_compression_level(png, png_level);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, head.width, head.height, static_cast<int>(head.bits),
                 head.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (head.dots_per_m > 0) {
        png_set_pHYs(png, info, head.dots_per_m, head.dots_per_m, PNG_RESOLUTION_METER);
    }
    png_write_info(png, info);
}

} // namespace estampe
