// SPDX-License-Identifier: MIT
#include "core/tiff.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include <tiffio.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/new_image.hpp"
#include "core/tiff_floats.hpp"

namespace estampe {
namespace {

struct TiffSource {
    std::span<const std::byte> data;
    uint64_t position = 0;
    char message[1024] = {}; ///< as long as TIFFRGBAImageOK() asks for
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

/// libtiff reads from mapped memory alone, and does not write there.
int map_all(thandle_t handle, void** base, toff_t* size)
{
    const TiffSource& source = source_of(handle);
    *base = const_cast<std::byte*>(source.data.data());
    *size = source.data.size();
    return 1;
}

void unmap_nothing(thandle_t /*handle*/, void* /*base*/, toff_t /*size*/) {}

/// The first error says most: those that follow are its consequences.
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

/// libtiff multiplies colours by an alpha that is not associated. Textures want it straight, so libtiff is
/// told that it has been done.
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
    constexpr uint64_t best_ratio = 1040; // that of deflate
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
