// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <estampe/image.hpp>

#include "core/child/exchange.hpp"

namespace estampe {

/// Limits of images that this program reads: longest side and number of pixels.
inline constexpr uint32_t max_image_side = 16384;
inline constexpr uint64_t max_image_pixels = uint64_t{1} << 26;

/// Decodes a picture file: PNG (libpng), JPEG (libjpeg), WebP (libwebp), TIFF (libtiff), TGA, BMP or GIF
/// (stb_image) or PSD. The first bytes decide the format, not the file name. Grey, palette, 16-bit and opaque
/// images become four 8-bit channels. Colours are not converted, except CMYK; see inks_to_rgb(). Of a GIF,
/// the first frame is decoded.
///
/// Throws Error with `name` as its place if the data is of another kind, truncated, corrupt, or beyond the
/// limits above. Cost: about 20 ms per megapixel for PNG, half of it for JPEG. Thread-safe.
[[nodiscard]] Image decode_image(std::span<const std::byte> data, const std::string& name);

/// A 16-bit image: rows of four channels, from top to bottom.
struct DeepImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint16_t> rgba;
};

/// Decodes a PNG with 16 bits per channel without loss; returns nothing for any other data. Throws Error as
/// decode_image() does.
[[nodiscard]] std::optional<DeepImage> decode_deep_image(std::span<const std::byte> data,
                                                         const std::string& name);

/// Reads a picture file and decodes it in this process; for code that runs in a child process already. Other
/// code calls load_image(), which decodes the file in a child process. Throws Error as load_image() does.
[[nodiscard]] Image read_image(const std::filesystem::path& path, const ReadScope& scope = {});

/// Lists the members of Image, for send() and receive() of core/child/exchange.hpp.
template <Either<Image> T>
auto members(T& image)
{
    auto& [width, height, rgba] = image;
    return std::tie(width, height, rgba);
}

/// Returns whether the image has pixels, as many as its size says, and is within the limits above. For images
/// that come from another process.
[[nodiscard]] bool is_well_formed(const Image& image);

/// Encodes an image as PNG marked as sRGB, optimised for speed rather than size. `dots_per_m` is the print
/// resolution; 0 leaves it out. Throws Error if the image is empty or its size and bytes disagree.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image, uint32_t dots_per_m = 0);

/// Encodes an image as PNG with 16 bits per channel: red, green, blue, and alpha if there are four channels.
[[nodiscard]] std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                                std::span<const uint16_t> values, uint32_t dots_per_m = 0);

/// An 8-bit PNG file that is written row by row, for pictures larger than memory. The file appears at its
/// path with publish().
class PngFile {
public:
    /// Starts a PNG file. `dots_per_m` is the print resolution; 0 leaves it out. Throws Error if the file
    /// cannot be written.
    PngFile(const std::filesystem::path& path, uint32_t width, uint32_t height, uint32_t dots_per_m = 0);
    ~PngFile();
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    /// Adds rows of pixels with four bytes each. Throws Error if the disk is full.
    void add_rows(std::span<const uint8_t> rgba);

    /// Completes the PNG file after its last row. Throws Error if the disk is full or rows are missing.
    void publish();

private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

} // namespace estampe
