// SPDX-License-Identifier: MIT
#include "core/tiff_floats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include <half.h>

#include "core/new_image.hpp"
#include "core/srgb.hpp"

namespace estampe {
namespace {

constexpr uint16_t most_samples = 16; // more are bands of a satellite

struct Layout {
    uint16_t samples = 1;
    uint16_t bits = 1;
    uint16_t colors = 1; ///< 1 for grey, 3 for RGB
    bool has_alpha = false;
    bool is_alpha_in_colors = false; ///< colours are multiplied by it
    bool is_planar = false;          ///< one plane after another, which is not read
    bool is_from_bottom = false;
};

Layout layout_of(TIFF* tiff)
{
    Layout layout;
    uint16_t photometric = PHOTOMETRIC_MINISBLACK;
    uint16_t planes = PLANARCONFIG_CONTIG;
    uint16_t orientation = ORIENTATION_TOPLEFT;
    uint16_t extra_count = 0;
    uint16_t* extra = nullptr;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra);
    layout.colors = photometric == PHOTOMETRIC_RGB ? 3 : photometric == PHOTOMETRIC_MINISBLACK ? 1 : 0;
    layout.has_alpha = extra_count > 0 && layout.samples > layout.colors;
    layout.is_alpha_in_colors = layout.has_alpha && extra[0] == EXTRASAMPLE_ASSOCALPHA;
    layout.is_planar = planes == PLANARCONFIG_SEPARATE && layout.samples > 1;
    layout.is_from_bottom = orientation == ORIENTATION_BOTLEFT || orientation == ORIENTATION_BOTRIGHT;
    return layout;
}

template <class Number>
Number number_at(const std::vector<std::byte>& row, size_t index)
{
    Number number;
    std::memcpy(&number, row.data() + index * sizeof(Number), sizeof(Number));
    return number;
}

float sample_at(const std::vector<std::byte>& row, size_t index, uint16_t bits)
{
    if (bits == 16) {
        Imath::half number;
        number.setBits(number_at<uint16_t>(row, index));
        return number;
    }
    return bits == 64 ? static_cast<float>(number_at<double>(row, index)) : number_at<float>(row, index);
}

float within_one(float value)
{
    return value > 0.0F ? std::min(value, 1.0F) : 0.0F; // 0 for what is no number
}

uint8_t byte_of(float value)
{
    return static_cast<uint8_t>(std::lround(255.0F * value));
}

/// The bytes of a pixel whose samples are these: colours, then alpha.
void put_pixel(const std::array<float, 4>& samples, const Layout& layout, uint8_t* rgba)
{
    const float alpha = layout.has_alpha ? within_one(samples[layout.colors]) : 1.0F;
    const float share = layout.is_alpha_in_colors && alpha > 0.0F ? alpha : 1.0F;
    for (size_t channel = 0; channel < 3; ++channel) {
        const float linear = samples[layout.colors == 1 ? 0 : channel] / share;
        rgba[channel] = byte_of(srgb_from_linear(within_one(linear)));
    }
    rgba[3] = byte_of(alpha);
}

} // namespace

bool has_float_samples(TIFF* tiff)
{
    uint16_t format = SAMPLEFORMAT_UINT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    const Layout layout = layout_of(tiff);
    const bool is_known_size = layout.bits == 16 || layout.bits == 32 || layout.bits == 64;
    return format == SAMPLEFORMAT_IEEEFP && is_known_size && layout.colors > 0 &&
           layout.samples >= layout.colors && layout.samples <= most_samples && !layout.is_planar &&
           TIFFIsTiled(tiff) == 0;
}

Image decode_float_tiff(TIFF* tiff, uint32_t width, uint32_t height, const std::string& name)
{
    const Layout layout = layout_of(tiff);
    const size_t wanted = layout.colors + (layout.has_alpha ? 1U : 0U);
    const auto row_bytes = static_cast<size_t>(std::max<tmsize_t>(TIFFScanlineSize(tiff), 0));
    if (row_bytes < size_t{width} * layout.samples * layout.bits / 8)
        throw Error("corrupt TIFF: its rows are too short", name);
    Image image = new_image(width, height, name);
    std::vector<std::byte> row(row_bytes);
    for (uint32_t y = 0; y < height; ++y) {
        if (TIFFReadScanline(tiff, row.data(), y, 0) < 0)
            throw Error(fmt::format("corrupt TIFF: row {} cannot be read", y), name);
        const uint32_t target_row = layout.is_from_bottom ? height - 1 - y : y;
        uint8_t* target = image.rgba.data() + size_t{4} * width * target_row;
        for (size_t x = 0; x < width; ++x, target += 4) {
            std::array<float, 4> samples{};
            for (size_t i = 0; i < wanted; ++i)
                samples[i] = sample_at(row, x * layout.samples + i, layout.bits);
            put_pixel(samples, layout, target);
        }
    }
    return image;
}

} // namespace estampe
