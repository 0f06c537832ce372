// SPDX-License-Identifier: MIT
#include "core/image_formats.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <half.h>
#include <tiffio.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/color.hpp"

namespace estampe {
namespace {

struct TiffSource {
    std::span<const std::byte> data;
    uint64_t position = 0;
    char message[1024] = {}; ///< libtiff's TIFFRGBAImageOK() requires a buffer of this size
};

TiffSource& source_of(thandle_t handle)
{
    return *static_cast<TiffSource*>(handle);
}

tmsize_t read_bytes(thandle_t handle, void* target, tmsize_t count)
{
    TiffSource& source = source_of(handle);
    if (count <= 0 || source.position >= source.data.size())
        return 0;
    const size_t taken =
        std::min<uint64_t>(static_cast<uint64_t>(count), source.data.size() - source.position);
    std::memcpy(target, source.data.data() + source.position, taken);
    source.position += taken;
    return static_cast<tmsize_t>(taken);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*bytes*/, tmsize_t /*count*/)
{
    return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int whence)
{
    TiffSource& source = source_of(handle);
    const uint64_t from = whence == SEEK_CUR ? source.position : whence == SEEK_END ? source.data.size() : 0;
    source.position = from + offset;
    return source.position;
}

int close_nothing(thandle_t /*handle*/)
{
    return 0;
}

toff_t size_of(thandle_t handle)
{
    return source_of(handle).data.size();
}

/// Gives libtiff the file's bytes as mapped memory, which libtiff only reads.
int map_all(thandle_t handle, void** base, toff_t* size)
{
    const TiffSource& source = source_of(handle);
    *base = const_cast<std::byte*>(source.data.data());
    *size = source.data.size();
    return 1;
}

void unmap_nothing(thandle_t /*handle*/, void* /*base*/, toff_t /*size*/) {}

/// Keeps the first error message of libtiff; later errors follow from the first.
int keep_message(TIFF* /*tiff*/, void* target, const char* /*module*/, const char* format, va_list values)
{
    auto& source = *static_cast<TiffSource*>(target);
    if (source.message[0] == '\0')
        std::vsnprintf(source.message, sizeof source.message, format, values);
    return 1;
}

int ignore_warning(TIFF* /*tiff*/, void* /*target*/, const char* /*module*/, const char* /*format*/,
                   va_list /*values*/)
{
    return 1;
}

struct TiffClose {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

using Tiff = std::unique_ptr<TIFF, TiffClose>;

Tiff open_tiff(TiffSource& source)
{
    constexpr tmsize_t most_bytes_at_once = tmsize_t{1} << 29;
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                   TIFFOpenOptionsFree);
    if (options == nullptr)
        return nullptr;
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), most_bytes_at_once);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &source);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, &source);
    return Tiff(TIFFClientOpenExt("", "r", &source, read_bytes, write_nothing, seek, close_nothing, size_of,
                                  map_all, unmap_nothing, options.get()));
}

enum class Alpha { straight, premultiplied };

/// Makes libtiff keep straight alpha. libtiff premultiplies colours by unassociated alpha, but textures use
/// straight alpha, so this code declares the alpha as associated, which prevents the multiplication.
Alpha take_alpha(TIFF* tiff)
{
    uint16_t count = 0;
    uint16_t* kinds = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) == 0 || count == 0)
        return Alpha::straight;
    if (kinds[0] == EXTRASAMPLE_ASSOCALPHA)
        return Alpha::premultiplied;
    std::vector<uint16_t> own(kinds, kinds + count);
    if (own[0] == EXTRASAMPLE_UNASSALPHA) {
        own[0] = EXTRASAMPLE_ASSOCALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, count, own.data());
    }
    return Alpha::straight;
}

void divide_by_alpha(Image& image)
{
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const uint32_t alpha = image.rgba[i + 3];
        for (size_t channel = i; alpha > 0 && channel < i + 3; ++channel)
            image.rgba[channel] = static_cast<uint8_t>(
                std::min<uint32_t>(255, (image.rgba[channel] * 255U + alpha / 2) / alpha));
    }
}

// Largest number of samples per pixel; more samples are bands of satellite images.
constexpr uint16_t most_samples = 16;

struct FloatLayout {
    uint16_t samples = 1;
    uint16_t bits = 1;
    uint16_t colors = 1; ///< Number of colour samples per pixel: 1 for grey, 3 for RGB
    bool has_alpha = false;
    bool is_alpha_in_colors = false; ///< The file's colours are premultiplied by alpha
    bool is_planar = false; ///< Channels are in separate planes, a layout that this decoder does not support
    bool is_from_bottom = false;
};

FloatLayout float_layout_of(TIFF* tiff)
{
    FloatLayout layout;
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
    return value > 0.0F ? std::min(value, 1.0F) : 0.0F; // Negative numbers and NaN become 0
}

uint8_t byte_of(float value)
{
    return static_cast<uint8_t>(std::lround(255.0F * value));
}

/// Converts the samples of one pixel to bytes: its colours, then its alpha.
void put_pixel(const std::array<float, 4>& samples, const FloatLayout& layout, uint8_t* rgba)
{
    const float alpha = layout.has_alpha ? within_one(samples[layout.colors]) : 1.0F;
    const float share = layout.is_alpha_in_colors && alpha > 0.0F ? alpha : 1.0F;
    for (size_t channel = 0; channel < 3; ++channel) {
        const float linear = samples[layout.colors == 1 ? 0 : channel] / share;
        rgba[channel] = byte_of(srgb_from_linear(within_one(linear)));
    }
    rgba[3] = byte_of(alpha);
}

/// Returns whether the samples of a TIFF are floats of 16, 32 or 64 bits, grey or RGB, in strips and
/// interleaved. libtiff does not convert floats to bytes.
bool has_float_samples(TIFF* tiff)
{
    uint16_t format = SAMPLEFORMAT_UINT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    const FloatLayout layout = float_layout_of(tiff);
    const bool is_known_size = layout.bits == 16 || layout.bits == 32 || layout.bits == 64;
    return format == SAMPLEFORMAT_IEEEFP && is_known_size && layout.colors > 0 &&
           layout.samples >= layout.colors && layout.samples <= most_samples && !layout.is_planar &&
           TIFFIsTiled(tiff) == 0;
}

/// Decodes a TIFF of floating-point samples. Colours are linear, as programs write them, and are encoded as
/// sRGB; values outside 0 to 1 are clamped. Throws Error that names the picture if a row is unreadable.
/// Memory: the picture and one row.
Image decode_float_tiff(TIFF* tiff, uint32_t width, uint32_t height, const std::string& name)
{
    const FloatLayout layout = float_layout_of(tiff);
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

} // namespace

bool is_tiff(std::span<const std::byte> data)
{
    using Magic = std::array<unsigned char, 4>;
    constexpr unsigned char classic = 42;
    constexpr unsigned char big = 43;
    const auto starts_with = [data](const Magic& magic) {
        return data.size() >= 8 && std::memcmp(data.data(), magic.data(), magic.size()) == 0;
    };
    return starts_with({'I', 'I', classic, 0}) || starts_with({'M', 'M', 0, classic}) ||
           starts_with({'I', 'I', big, 0}) || starts_with({'M', 'M', 0, big});
}

Image decode_tiff(std::span<const std::byte> data, const std::string& name)
{
    TiffSource source{.data = data};
    const auto refuse = [&source, &name](const char* what) {
        throw Error(fmt::format("{}: {}", what, source.message), name);
    };
    const Tiff tiff = open_tiff(source);
    if (tiff == nullptr)
        refuse("corrupt TIFF");
    uint32_t width = 0;
    uint32_t height = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
    check_image_size(width, height, name);
    uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_COMPRESSION, &compression);
    if (compression == COMPRESSION_OJPEG)
        throw Error("TIFF holds JPEG data in the form of 1992, which is not read", name);
    // Largest compression ratio of deflate, by which a damaged file is recognised.
    constexpr uint64_t best_ratio = 1040;
    if (uint64_t{width} * height > 64 * best_ratio * data.size())
        throw Error(
            fmt::format("corrupt TIFF: {} x {} pixels cannot come from {} bytes", width, height, data.size()),
            name);
    if (has_float_samples(tiff.get()))
        return decode_float_tiff(tiff.get(), width, height, name);
    const Alpha alpha = take_alpha(tiff.get());
    if (TIFFRGBAImageOK(tiff.get(), source.message) == 0)
        refuse("TIFF cannot be read");
    source.message[0] = '\0';
    Image image = new_image(width, height, name);
    static_assert(std::endian::native == std::endian::little, "libtiff packs red into the lowest byte");
    auto* const pixels = reinterpret_cast<uint32_t*>(image.rgba.data());
    constexpr int stop_on_error = 1;
    if (TIFFReadRGBAImageOriented(tiff.get(), width, height, pixels, ORIENTATION_TOPLEFT, stop_on_error) == 0)
        refuse("corrupt TIFF");
    if (alpha == Alpha::premultiplied)
        divide_by_alpha(image);
    return image;
}

} // namespace estampe
