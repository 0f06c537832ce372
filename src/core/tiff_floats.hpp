// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <tiffio.h>

#include <estampe/image.hpp>

namespace estampe {

/// Whether the samples are floating-point numbers of 16, 32 or 64 bits, grey or RGB, in strips and
/// pixel by pixel. libtiff itself does not turn these into bytes.
[[nodiscard]] bool has_float_samples(TIFF* tiff);

/// Reads such a picture. Colours are linear, as programs write them, and become sRGB; what is beyond 0 to 1
/// is clamped. Throws Error naming the picture when a row cannot be read. Memory: the picture, and a row.
[[nodiscard]] Image decode_float_tiff(TIFF* tiff, uint32_t width, uint32_t height, const std::string& name);

} // namespace estampe
