// SPDX-License-Identifier: MIT
#include <bit>

#include <png.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/codec_failure.hpp"
#include "core/image_codec.hpp"

namespace estampe {
namespace {

/// Samples as they lie in memory, row by row without gaps.
struct Samples {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;
    uint32_t bits = 8;
    std::span<const std::byte> bytes;

    [[nodiscard]] uint64_t row_bytes() const { return uint64_t{width} * channels * bits / 8; }
};

struct PngWriter {
    png_structp png = nullptr;
    png_infop info = nullptr;
    CodecFailure failure;
    std::vector<std::byte> bytes;

    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

void append(png_structp png, png_bytep data, png_size_t count)
{
    auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + count);
}

bool write(PngWriter& writer, const Samples& samples)
{
    if (setjmp(writer.failure.jump) != 0) {
        return false;
    }
    png_set_write_fn(writer.png, &writer.bytes, append, nullptr);
    png_set_compression_level(writer.png, 3);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(writer.png, writer.info, samples.width, samples.height, static_cast<int>(samples.bits),
                 samples.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer.png, writer.info);
    if (samples.bits == 16 && std::endian::native == std::endian::little) {
        png_set_swap(writer.png);
    }
    for (uint32_t row = 0; row < samples.height; ++row) {
        png_write_row(writer.png,
                      reinterpret_cast<png_const_bytep>(samples.bytes.data()) + samples.row_bytes() * row);
    }
    png_write_end(writer.png, writer.info);
    return true;
}

std::vector<std::byte> encode(const Samples& samples)
{
    if (samples.bytes.empty() || samples.bytes.size() != samples.row_bytes() * samples.height) {
        throw Error(fmt::format("an image of {} x {} pixels with {} bytes cannot be written", samples.width,
                                samples.height, samples.bytes.size()));
    }
    PngWriter writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.failure, png_failed, png_warned);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw Error("out of memory");
    }
    writer.bytes.reserve(samples.bytes.size() / 4);
    if (!write(writer, samples)) {
        throw Error(fmt::format("cannot encode PNG: {}", writer.failure.message));
    }
    return std::move(writer.bytes);
}

} // namespace

std::vector<std::byte> encode_png(const Image& image)
{
    return encode(
        {.width = image.width, .height = image.height, .bytes = std::as_bytes(std::span(image.rgba))});
}

std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                  std::span<const uint16_t> values)
{
    return encode(
        {.width = width, .height = height, .channels = channels, .bits = 16, .bytes = std::as_bytes(values)});
}

} // namespace estampe
