// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// A picture in linear light: the primaries of Rec. 709 and its white, D65, where 1 is the white of a screen;
/// the heights of white paper lie a little above. Rows from top to bottom.
struct LinearImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec4> pixels; ///< width * height; colours are multiplied by their alpha
    /// The linear colour of the paper that is left out of a transparent picture. Not given: the picture is
    /// opaque, and is written without alpha.
    std::optional<glm::vec3> paper;

    [[nodiscard]] bool empty() const noexcept { return pixels.empty(); }

    bool operator==(const LinearImage&) const = default;
};

/// What numbers an OpenEXR picture is made of.
enum class ExrNumbers : uint8_t {
    half,  ///< 16 bits: 11 of them count, over 30 stops
    single ///< 32 bits
};

/// Writes `image` as PNG of 16 bits a channel, sRGB-encoded and marked so, beside `path` first and renamed
/// into place. What is above 1 becomes white. A transparent picture has straight alpha, such that programs
/// which lay it on its own paper in sRGB-encoded values show the opaque drawing. Throws Error when the folder
/// cannot be written or the image is empty. Cost: about 150 ms a megapixel.
void save_png(const LinearImage& image, const std::filesystem::path& path);

/// Writes `image` as OpenEXR, R, G and B in linear light with its primaries named in the header, in the same
/// way; a transparent picture also has A, by which the colours are multiplied. Throws Error as save_png()
/// does. Cost: about 50 ms a megapixel.
void save_exr(const LinearImage& image, const std::filesystem::path& path,
              ExrNumbers numbers = ExrNumbers::half);

} // namespace estampe
