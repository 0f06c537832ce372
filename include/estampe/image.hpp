// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace estampe {

/// An 8-bit picture: rows from top to bottom, four bytes a pixel (red, green, blue, alpha), sRGB-encoded.
/// Colours are not multiplied by alpha, which is linear.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba; ///< width * height * 4 bytes

    [[nodiscard]] bool empty() const noexcept { return rgba.empty(); }

    bool operator==(const Image&) const = default;
};

/// Writes `image` as PNG, beside `path` first and renamed into place, so that a failure leaves no half file.
/// Throws Error when the folder cannot be written or the image is empty. Cost: about 10 ms a megapixel.
void save_png(const Image& image, const std::filesystem::path& path);

/// Writes `image` as JPEG with colour at full size (4:4:4) and an sRGB profile, in the same way. Alpha is
/// left out. `quality` is 1 to 100. Throws Error as save_png() does, and when a side is longer than 65500
/// pixels, which libjpeg does not write. Cost: about 20 ms a megapixel.
void save_jpeg(const Image& image, const std::filesystem::path& path, int quality = 92);

/// Writes `image` as WebP with an sRGB profile, in the same way: without loss, or of a `quality` of 0 to 100.
/// Throws Error as save_png() does, and when a side is longer than 16383 pixels, which WebP cannot hold.
/// Cost: about 0.5 s a megapixel.
void save_webp(const Image& image, const std::filesystem::path& path, std::optional<int> quality = {});

/// Reads a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD file into an Image, whatever its name; see
/// docs/reference/formats.md. Throws Error naming the file when it is missing, truncated or too large.
[[nodiscard]] Image load_image(const std::filesystem::path& path);

} // namespace estampe
