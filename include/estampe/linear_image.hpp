// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// A picture in linear light: Rec. 709 primaries, white point D65, the value 1 is the white of a screen. The
/// bright parts of paper texture are slightly above 1. Rows run from top to bottom.
struct LinearImage {
    uint32_t width = 0;
    uint32_t height = 0;
    /// Colour and alpha per pixel, width * height values; colours are premultiplied by alpha.
    std::vector<glm::vec4> pixels;
    /// Linear colour of the paper that a transparent picture leaves out. Empty: the picture is opaque and is
    /// written without alpha.
    std::optional<glm::vec3> paper;

    [[nodiscard]] bool empty() const noexcept { return pixels.empty(); }

    bool operator==(const LinearImage&) const = default;
};

/// Number format of an OpenEXR picture.
enum class ExrNumbers : uint8_t {
    half,  ///< Half floats of 16 bits: 11 significant bits over a range of 30 stops
    single ///< Single-precision floats of 32 bits
};

/// Writes `image` as PNG with 16 bits per channel, sRGB-encoded and marked as sRGB. Values above 1 become
/// white. A transparent picture gets straight (not premultiplied) alpha. Programs that composite its
/// sRGB-encoded values onto the paper colour show the opaque drawing. The file is written beside `path` and
/// renamed. Throws Error if the folder is not writable or the image is empty. Cost: about 150 ms per
/// megapixel.
void save_png(const LinearImage& image, const std::filesystem::path& path);

/// Writes `image` as OpenEXR: R, G and B in linear light with the primaries in the header. A transparent
/// picture also has A, and its colours are premultiplied. The file is written beside `path` and renamed.
/// Throws Error as save_png() does. Cost: about 50 ms per megapixel.
void save_exr(const LinearImage& image, const std::filesystem::path& path,
              ExrNumbers numbers = ExrNumbers::half);

} // namespace estampe
