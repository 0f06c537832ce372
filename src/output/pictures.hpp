// SPDX-License-Identifier: MIT
#pragma once

// Pictures as the bytes of files, and files of them.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

#include "core/file.hpp"

namespace estampe::output {

/// A profile of the ICC, version 4, that says sRGB; always the same bytes, some 600.
[[nodiscard]] const std::vector<std::byte>& srgb_profile();

/// As save_jpeg(), save_webp(), save_png() and save_exr() write them. Throw Error as those do, but name no
/// file.
/// `dots_per_m` is how finely a picture is to be printed, where the format can tell; 0 says nothing of that.
[[nodiscard]] std::vector<std::byte> encode_jpeg(const Image& image, int quality, uint32_t dots_per_m = 0);
[[nodiscard]] std::vector<std::byte> encode_webp(const Image& image, std::optional<int> quality);
[[nodiscard]] std::vector<std::byte> encode_deep_png(const LinearImage& image, uint32_t dots_per_m = 0);
[[nodiscard]] std::vector<std::byte> encode_picture_exr(const LinearImage& image, ExrNumbers numbers);

/// Throws Error when the picture is empty, or its size and number of pixels disagree.
void check_pixels(const LinearImage& image);

/// Writes the bytes that `encode` makes to `path`, beside it first. What `encode` throws names the file.
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
