// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// Layers of a DDS file, each with its mip levels from the finest, as many as the file holds.
struct DdsImages {
    uint32_t size_px = 0;
    std::vector<std::vector<Gray8>> level_of_layer; ///< coverage: black is ink
};

/// Reads an uncompressed DDS file: 8-bit luminance or alpha, 24- or 32-bit colour by masks, or by a DX10
/// header R8, RGBA8 or BGRA8; one image, an array (a tone a layer), or a volume (a tone a slice, of which
/// only level 0 is read, as coarser levels hold fewer slices). Throws Error naming `name` when it is of
/// another kind, truncated, not square, or beyond the limits of TonalArtMap.
///
/// Source  Microsoft, "Programming Guide for DDS"
[[nodiscard]] DdsImages decode_dds(std::span<const std::byte> bytes, const std::string& name);

/// A DDS file of all tones: an array of R8 images with their own mip levels, black ink on white.
[[nodiscard]] std::vector<std::byte> encode_dds(const TonalArtMap& map);

} // namespace estampe::tam
