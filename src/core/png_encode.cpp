// SPDX-License-Identifier: MIT
#include <png.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/codec_failure.hpp"
#include "core/image_codec.hpp"
#include "core/png_head.hpp"
#include "core/png_strips.hpp"

namespace estampe {
namespace {

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

bool write(PngWriter& writer, const PngHead& head, const std::vector<std::vector<std::byte>>& rows)
{
    if (setjmp(writer.failure.jump) != 0) {
        return false;
    }
    png_set_write_fn(writer.png, &writer.bytes, append, nullptr);
    png_write_head(writer.png, writer.info, head);
    for (const std::vector<std::byte>& part : rows) {
        png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IDAT"),
                        reinterpret_cast<png_const_bytep>(part.data()), part.size());
    }
    // png_write_end() wants to have deflated the rows itself.
    png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
    return true;
}

std::vector<std::byte> encode(const PngPixels& pixels, uint32_t dots_per_m)
{
    if (pixels.bytes.empty() || pixels.bytes.size() != pixels.row_bytes() * pixels.height) {
        throw Error(fmt::format("an image of {} x {} pixels with {} bytes cannot be written", pixels.width,
                                pixels.height, pixels.bytes.size()));
    }
    PngWriter writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.failure, png_failed, png_warned);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw Error("out of memory");
    }
    writer.bytes.reserve(pixels.bytes.size() / 4);
    const PngHead head{.width = pixels.width,
                       .height = pixels.height,
                       .channels = pixels.channels,
                       .bits = pixels.bits,
                       .dots_per_m = dots_per_m};
    if (!write(writer, head, deflate_png_rows(pixels))) {
        throw Error(fmt::format("cannot encode PNG: {}", writer.failure.message));
    }
    return std::move(writer.bytes);
}

} // namespace

std::vector<std::byte> encode_png(const Image& image, uint32_t dots_per_m)
{
    return encode(
        {.width = image.width, .height = image.height, .bytes = std::as_bytes(std::span(image.rgba))},
        dots_per_m);
}

std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                  std::span<const uint16_t> values, uint32_t dots_per_m)
{
    return encode(
        {.width = width, .height = height, .channels = channels, .bits = 16, .bytes = std::as_bytes(values)},
        dots_per_m);
}

} // namespace estampe
