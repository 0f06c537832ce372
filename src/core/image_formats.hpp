// SPDX-License-Identifier: MIT
#pragma once

// What the decoders behind image_codec.hpp share: single formats, images of a checked size, how libpng and
// libjpeg fail.

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

/// How libpng and libjpeg come back from an error, which they tell by calling a function that must not
/// return: whatever has a destructor lives outside the frame that longjmp leaves.
struct CodecFailure {
    std::jmp_buf jump;
    char message[256] = {};
};

/// Of libpng, whose error pointer is a CodecFailure.
[[noreturn]] inline void png_failed(png_structp png, png_const_charp message)
{
    auto* failure = static_cast<CodecFailure*>(png_get_error_ptr(png));
    std::snprintf(failure->message, sizeof failure->message, "%s", message);
    std::longjmp(failure->jump, 1);
}

inline void png_warned(png_structp /*png*/, png_const_charp /*message*/) {}

/// Throws Error with `name` as its place when an image of that size is beyond the limits of what is read.
inline void check_image_size(uint64_t width, uint64_t height, const std::string& name)
{
    if (width == 0 || height == 0 || width > max_image_side || height > max_image_side ||
        width * height > max_image_pixels) {
        throw Error(fmt::format("image of {} x {} pixels is beyond the limit of {} x {} and {} megapixels",
                                width, height, max_image_side, max_image_side, max_image_pixels >> 20),
                    name);
    }
}

/// An image of that size, all zeros, after its size and the free memory have been checked.
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

/// Replaces pixels of cyan, magenta, yellow and black, 8 bits each, by opaque sRGB, in place. Converts with
/// the ICC profile where that is one for CMYK (lcms2), else as if each ink removed its share of the light.
/// `inverted`: 255 means no ink.
void inks_to_rgb(std::span<uint8_t> pixels, bool inverted, std::span<const std::byte> profile);

/// Decodes a TGA, BMP or GIF (its first frame) with stb_image, or the flattened picture of a PSD; nothing
/// when the data is none of these. Told apart by content: TGA has no magic number, so its header has to be
/// sound in every field. Throws Error with `name` as its place when the data is cut short, damaged or of an
/// unusual kind: stb_image itself would take missing bytes for zeros.
[[nodiscard]] std::optional<Image> decode_older_picture(std::span<const std::byte> data,
                                                        const std::string& name);

[[nodiscard]] bool is_tiff(std::span<const std::byte> data);

/// Decodes the first picture of a TIFF or BigTIFF file with libtiff: strips and tiles, palettes, grey, RGB,
/// CMYK and YCbCr, 1 to 16 bits per channel, alpha associated or not. Throws Error with `name` as its place
/// when the data is damaged, too large, or of a kind that cannot be shown in 8 bits per channel.
[[nodiscard]] Image decode_tiff(std::span<const std::byte> data, const std::string& name);

} // namespace estampe
