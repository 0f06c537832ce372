// SPDX-License-Identifier: MIT
#pragma once

// Reads and writes tonal art maps: `.tam` archives, DDS files, and folders of images.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/read_scope.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

using estampe::PaintedMap;

/// Implements estampe::load_tonal_art_map(). Decodes the files in a child process. Levels that the files lack
/// are derived, see painted_strokes.hpp.
[[nodiscard]] PaintedMap read_map(const std::filesystem::path& path, const ReadScope& scope = {});

/// Implements estampe::is_map_folder().
[[nodiscard]] bool is_folder_name(const std::filesystem::path& path);

/// Implements estampe::save_tonal_art_map().
void write_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Makes a map from painted images. Tones are given from light to dark, each with level 0 and any number of
/// coarser levels; images of one level have equal size. Measures the darkness of the tones if `darkness` is
/// empty. `where` names the source in errors.
[[nodiscard]] PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                                      std::vector<float> darkness, const std::string& where);

// A `.tam` file is a zip archive that any archiver opens. The file `tam.toml` in the archive contains the
// size and the darknesses. Each tone and level is a PNG, `tone1_level0.png` and so on, with black ink on
// white. If the map has thresholds, the thresholds are PNGs as well, `threshold_level0.png` and so on. The
// same map always gives the same bytes.

/// Writes a map in the format of a `.tam` file. Throws Error if the map is invalid.
[[nodiscard]] std::vector<std::byte> encode_tam(const TonalArtMap& map);

/// Reads a map in the format of a `.tam` file, also after an artist has painted over its images. Throws Error
/// naming `name` and the entry of the archive if anything is missing, damaged, of the wrong size, or beyond
/// the limits of TonalArtMap. Memory stays within a few times the size of the largest valid map, whatever the
/// input.
[[nodiscard]] TonalArtMap decode_tam(std::span<const std::byte> bytes, const std::string& name);

/// Saves a map as a `.tam` file: writes a temporary file beside `path`, then renames it. Throws Error.
void save_tam(const TonalArtMap& map, const std::filesystem::path& path);

/// Reads a `.tam` file in this process; for files that this program wrote itself, as a cache.
[[nodiscard]] TonalArtMap load_tam(const std::filesystem::path& path, const ReadScope& scope = {});

[[nodiscard]] std::string manifest_of(const TonalArtMap& map);

/// The contents of `tam.toml`: the size, the darknesses, and whether the map has thresholds.
struct Manifest {
    uint32_t size_px = 0;
    std::vector<float> darkness;
    bool has_thresholds = false;
};

/// Parses the text of `tam.toml`. Throws Error with name:line:column for a mistake in the text.
[[nodiscard]] Manifest parse_manifest(const std::string& text, const std::string& name);

/// File name of an image in a `.tam` archive, such as "tone1_level0.png". Names count tones from 1.
[[nodiscard]] std::string image_name(size_t tone, size_t level);

/// The layers of a DDS texture file. Each layer has all mip levels that the file contains, finest first.
struct DdsImages {
    uint32_t size_px = 0;
    /// Coverage of each texel: 255 (ink) where the file is black.
    std::vector<std::vector<Gray8>> level_of_layer;
};

/// Reads an uncompressed DDS file. The file's texels are 8-bit luminance or alpha, 24- or 32-bit colour with
///       masks, or, with a DX10 header, R8, RGBA8 or BGRA8. The file may contain one image, an array (one
///       tone per layer), or a volume (one tone per slice). A volume's coarser mip levels have fewer slices:
///       each tone is blended from the two slices nearest in darkness, as long as the level has at least two
///       slices. Throws Error naming `name` if the file has another format, is truncated, is not square, or
///       exceeds the limits of TonalArtMap.
///
/// Source  Microsoft, "Programming Guide for DDS"
[[nodiscard]] DdsImages decode_dds(std::span<const std::byte> bytes, const std::string& name);

/// Writes all tones as a DDS file: an array of R8 images with their own mip levels, black ink on white.
[[nodiscard]] std::vector<std::byte> encode_dds(const TonalArtMap& map);

/// Converts coverage to a picture on which one can paint: ink is black, paper is white.
[[nodiscard]] Image picture_of(const Gray8& coverage, uint32_t size_px);

/// Converts a picture to coverage (ink per texel): its darkness, with transparent pixels over white.
[[nodiscard]] Gray8 coverage_of(const Image& picture);

/// Decodes a square PNG to coverage (ink per texel) and the length of its side. Throws Error naming `name` if
/// the file is not a PNG, is damaged, is not square, or its side is not a power of two or exceeds
/// max_size_px. Checks the size before it allocates memory.
struct Square {
    uint32_t size_px = 0;
    Gray8 coverage;
};

[[nodiscard]] Square decode_square(std::span<const std::byte> png, const std::string& name);

} // namespace estampe::tam
