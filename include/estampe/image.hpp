// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <estampe/read_scope.hpp>

namespace estampe {

/// An 8-bit picture: rows from top to bottom, four bytes per pixel (red, green, blue, alpha). Colours are
/// sRGB-encoded and not premultiplied; alpha is linear.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba; ///< Pixels of the picture, width * height * 4 bytes

    [[nodiscard]] bool empty() const noexcept { return rgba.empty(); }

    bool operator==(const Image&) const = default;
};

/// Writes `image` as PNG. A temporary file beside `path` is renamed when it is complete, so a failure leaves
/// no partial file. Throws Error if the folder is not writable or the image is empty. Cost: about 10 ms per
/// megapixel.
void save_png(const Image& image, const std::filesystem::path& path);

/// Writes `image` as JPEG with full-resolution colour (4:4:4) and an sRGB profile, through a temporary file
/// as save_png() does. Alpha is ignored. `quality` is 1 to 100. Throws Error as save_png() does, and if a
/// side is longer than 65500 pixels, libjpeg's limit. Cost: about 20 ms per megapixel.
void save_jpeg(const Image& image, const std::filesystem::path& path, int quality = 92);

/// Writes `image` as WebP with an sRGB profile, through a temporary file as save_png() does. `quality` is 0
/// to 100; without a quality the file is lossless. Throws Error as save_png() does, and if a side is longer
/// than 16383 pixels, WebP's limit. Cost: about 0.5 s per megapixel.
void save_webp(const Image& image, const std::filesystem::path& path, std::optional<int> quality = {});

/// Reads a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD file. The file's content decides the format, not its
/// name. docs/reference/formats.md lists the supported variants of these formats. Throws Error that names the
/// file if it is missing, truncated or too large, or lies outside of `scope`.
[[nodiscard]] Image load_image(const std::filesystem::path& path, const ReadScope& scope = {});

} // namespace estampe
