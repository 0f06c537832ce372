// SPDX-License-Identifier: MIT
#pragma once

// Encodes pictures as files of all formats.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

#include "core/file.hpp"

namespace estampe::output {

/// Returns an sRGB profile of ICC version 4, about 600 bytes; always the same bytes.
[[nodiscard]] const std::vector<std::byte>& srgb_profile();

/// Encode the files of save_jpeg(), save_webp(), save_png() and save_exr(). The encoders throw Error in the
/// same cases as the save functions, but without a file name. `dots_per_m` is the print resolution, stored if
/// the format allows it; 0: not stored.
[[nodiscard]] std::vector<std::byte> encode_jpeg(const Image& image, int quality, uint32_t dots_per_m = 0);
[[nodiscard]] std::vector<std::byte> encode_webp(const Image& image, std::optional<int> quality);
[[nodiscard]] std::vector<std::byte> encode_deep_png(const LinearImage& image, uint32_t dots_per_m = 0);
[[nodiscard]] std::vector<std::byte> encode_picture_exr(const LinearImage& image, ExrNumbers numbers);

/// Checks that a picture has pixels. Throws Error if the picture is empty or its size and pixel count
/// disagree.
void check_pixels(const LinearImage& image);

/// Writes the bytes that `encode` returns to `path`, through a temporary file. Adds the file name to Errors
/// of `encode`.
template <class Encode>
void save_as(const std::filesystem::path& path, const Encode& encode)
{
    std::vector<std::byte> bytes;
    try {
        bytes = encode();
    } catch (const Error& error) {
        throw error.where().empty() ? Error(error.what(), path.string()) : error;
    }
    write_file_atomically(path, bytes);
}

} // namespace estampe::output
