// SPDX-License-Identifier: MIT
#include "techniques/tam/files/images.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/image_codec.hpp"

namespace estampe::tam {
namespace {

/// A number of the header of a PNG, which begins at byte 16 with width and height, most significant byte
/// first.
uint32_t header_number(std::span<const std::byte> png, size_t at)
{
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value = value << 8U | std::to_integer<uint32_t>(png[at + i]);
    }
    return value;
}

} // namespace

Image picture_of(const Gray8& coverage, uint32_t size_px)
{
    Image picture{.width = size_px, .height = size_px, .rgba = {}};
    picture.rgba.reserve(coverage.size() * 4);
    for (const uint8_t texel : coverage) {
        const auto grey = static_cast<uint8_t>(255 - texel);
        picture.rgba.insert(picture.rgba.end(), {grey, grey, grey, 255});
    }
    return picture;
}

Gray8 coverage_of(const Image& picture)
{
    Gray8 coverage;
    coverage.reserve(picture.rgba.size() / 4);
    for (size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
        const uint32_t light = (2U * picture.rgba[i] + 5U * picture.rgba[i + 1] + picture.rgba[i + 2]) / 8U;
        coverage.push_back(static_cast<uint8_t>(((255U - light) * picture.rgba[i + 3] + 127U) / 255U));
    }
    return coverage;
}

Square decode_square(std::span<const std::byte> png, const std::string& name)
{
    constexpr std::array<uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    constexpr size_t header_end = 24;
    const bool is_png =
        png.size() >= header_end &&
        std::equal(signature.begin(), signature.end(), png.begin(),
                   [](uint8_t wanted, std::byte found) { return std::byte{wanted} == found; });
    if (!is_png) {
        throw Error("is not a PNG image", name);
    }
    const uint32_t width = header_number(png, 16);
    const uint32_t height = header_number(png, 20);
    if (width != height || !std::has_single_bit(width) || width > max_size_px) {
        throw Error(fmt::format("is {} x {} pixels", width, height), name,
                    fmt::format("a level is square, its side a power of two up to {}", max_size_px));
    }
    return {width, coverage_of(decode_image(png, name))};
}

} // namespace estampe::tam
