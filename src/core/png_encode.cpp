// SPDX-License-Identifier: MIT
#include <bit>

#include <png.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/codec_failure.hpp"
#include "core/image_codec.hpp"
#include "core/png_head.hpp"

namespace estampe {
namespace {

/// Samples as they lie in memory, row by row without gaps.
struct Samples {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;
    uint32_t bits = 8;
    std::span<const std::byte> bytes;
    uint32_t dots_per_m = 0;

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
    png_write_head(writer.png, writer.info,
                   {.width = samples.width,
                    .height = samples.height,
                    .channels = samples.channels,
                    .bits = samples.bits,
                    .dots_per_m = samples.dots_per_m});
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

std::vector<std::byte> encode_png(const Image& image, uint32_t dots_per_m)
{
    return encode({.width = image.width,
                   .height = image.height,
                   .bytes = std::as_bytes(std::span(image.rgba)),
                   .dots_per_m = dots_per_m});
}

std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                  std::span<const uint16_t> values, uint32_t dots_per_m)
{
    return encode({.width = width,
                   .height = height,
                   .channels = channels,
                   .bits = 16,
                   .bytes = std::as_bytes(values),
                   .dots_per_m = dots_per_m});
}

} // namespace estampe
