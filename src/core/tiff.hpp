// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include <estampe/image.hpp>

namespace estampe {

[[nodiscard]] bool is_tiff(std::span<const std::byte> data);

/// Decodes the first picture of a TIFF or BigTIFF file with libtiff: strips and tiles, palettes, grey, RGB,
/// CMYK and YCbCr, 1 to 16 bits per channel, alpha associated or not. Throws Error with `name` as its place
/// when the data is damaged, too large, or of a kind that cannot be shown in 8 bits per channel.
[[nodiscard]] Image decode_tiff(std::span<const std::byte> data, const std::string& name);

} // namespace estampe
