// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>

namespace estampe {

/// The longest side and the most pixels of an image that is read.
inline constexpr uint32_t max_image_side = 16384;
inline constexpr uint64_t max_image_pixels = uint64_t{1} << 26;

/// Decodes PNG (libpng), JPEG (libjpeg), WebP (libwebp), TIFF (libtiff), TGA, BMP or GIF (stb_image) or PSD,
/// told apart by their first bytes, whatever the file is called. Grey, palette, 16-bit and opaque images all
/// become four 8-bit channels; colours are not converted, but for CMYK, see inks_to_rgb(). Of a GIF the first
/// frame is taken.
///
/// Throws Error with `name` as its place when the data is of another kind, truncated, corrupt, or beyond the
/// limits above. Cost: about 20 ms a megapixel for PNG, half of it for JPEG. Any number of threads may call
/// it.
[[nodiscard]] Image decode_image(std::span<const std::byte> data, const std::string& name);

/// Rows of four channels, from top to bottom.
struct DeepImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint16_t> rgba;
};

/// The same of a PNG of 16 bits a channel, of which none is lost; nothing of any other data.
[[nodiscard]] std::optional<DeepImage> decode_deep_image(std::span<const std::byte> data,
                                                         const std::string& name);

/// Encodes as PNG that says to be sRGB, for speed rather than size. Throws Error when the image is empty or
/// its size and bytes disagree. `dots_per_m` is how finely it is to be printed; 0 says nothing of that.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image, uint32_t dots_per_m = 0);

/// The same of 16 bits a channel, red, green, blue and with four channels alpha.
[[nodiscard]] std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                                std::span<const uint16_t> values, uint32_t dots_per_m = 0);

/// A PNG picture of eight bits a channel that is written as it comes, row by row, for pictures that memory
/// does not hold. Until publish() the file of that name is what it was.
class PngFile {
public:
    /// `dots_per_m` of 0 says nothing of the size on paper. Throws Error when the file cannot be written.
    PngFile(const std::filesystem::path& path, uint32_t width, uint32_t height, uint32_t dots_per_m = 0);
    ~PngFile();
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    /// The next rows, of four bytes a pixel. Throws Error when the disk is full.
    void add_rows(std::span<const uint8_t> rgba);

    /// To be called after the last row. Throws Error when the disk is full, and for rows too few.
    void publish();

private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

} // namespace estampe
