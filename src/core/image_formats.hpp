// SPDX-License-Identifier: MIT
#pragma once

// Code that the decoders of image_codec.hpp share: decoders of single formats, size-checked images, and error
// handling of libpng and libjpeg.

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>
#include <png.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/free_memory.hpp"
#include "core/image_codec.hpp"

namespace estampe {

/// Error state for libpng and libjpeg, whose error functions must not return. The error function leaves with
/// longjmp. Objects with destructors must be declared outside the stack frame that longjmp leaves.
struct CodecFailure {
    std::jmp_buf jump;
    char message[256] = {};
};

/// Error function for libpng; its error pointer must be a CodecFailure.
[[noreturn]] inline void png_failed(png_structp png, png_const_charp message)
{
    auto* failure = static_cast<CodecFailure*>(png_get_error_ptr(png));
    std::snprintf(failure->message, sizeof failure->message, "%s", message);
    std::longjmp(failure->jump, 1);
}

inline void png_warned(png_structp /*png*/, png_const_charp /*message*/) {}

/// Checks that an image of this size is within the limits for reading. Throws Error with `name` as its place
/// otherwise.
inline void check_image_size(uint64_t width, uint64_t height, const std::string& name)
{
    if (width == 0 || height == 0 || width > max_image_side || height > max_image_side ||
        width * height > max_image_pixels) {
        throw Error(fmt::format("image of {} x {} pixels is beyond the limit of {} x {} and {} megapixels",
                                width, height, max_image_side, max_image_side, max_image_pixels >> 20),
                    name);
    }
}

/// Makes an image whose pixels are all zero, after checks of its size and the free memory.
template <class Picture = Image>
Picture new_image(uint64_t width, uint64_t height, const std::string& name)
{
    check_image_size(width, height, name);
    require_memory(width * height * 4 * sizeof(typename decltype(Picture::rgba)::value_type),
                   fmt::format("an image of {} x {} pixels", width, height), name);
    Picture image{.width = static_cast<uint32_t>(width), .height = static_cast<uint32_t>(height), .rgba = {}};
    image.rgba.resize(width * height * 4);
    return image;
}

/// Converts 8-bit CMYK pixels to opaque sRGB in place. Uses `profile` if it is an ICC profile for CMYK
/// (lcms2); otherwise each ink absorbs its share of the light. If `inverted` is true, 255 means no ink.
void inks_to_rgb(std::span<uint8_t> pixels, bool inverted, std::span<const std::byte> profile);

/// Decodes a TGA, BMP or GIF (its first frame) with stb_image, or the flattened picture of a PSD; empty for
/// other data. The content decides the format. TGA has no magic number, so every field of its header must be
/// valid. Throws Error with `name` as its place if the data is truncated, damaged or of an unsupported kind.
/// stb_image itself would read missing bytes as zeros.
[[nodiscard]] std::optional<Image> decode_older_picture(std::span<const std::byte> data,
                                                        const std::string& name);

[[nodiscard]] bool is_tiff(std::span<const std::byte> data);

/// Decodes the first picture of a TIFF or BigTIFF file with libtiff: strips and tiles, palettes, grey, RGB,
/// CMYK and YCbCr, 1 to 16 bits per channel, associated or unassociated alpha. Throws Error with `name` as
/// its place if the data is damaged, too large, or cannot be shown in 8 bits per channel.
[[nodiscard]] Image decode_tiff(std::span<const std::byte> data, const std::string& name);

} // namespace estampe
