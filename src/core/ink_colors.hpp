// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace estampe {

/// Replaces pixels of cyan, magenta, yellow and black, 8 bits each, by opaque sRGB, in place. Converts with
/// the ICC profile where that is one for CMYK (lcms2), else as if each ink removed its share of the light.
/// `inverted`: 255 means no ink.
void inks_to_rgb(std::span<uint8_t> pixels, bool inverted, std::span<const std::byte> profile);

} // namespace estampe
