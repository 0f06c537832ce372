// SPDX-License-Identifier: MIT
#pragma once

// Reads and writes tonal art maps: `.tam` archives, DDS files, and folders of images.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

using estampe::PaintedMap;

/// Implements estampe::load_tonal_art_map(). For missing levels, see painted_strokes.hpp.
[[nodiscard]] PaintedMap read_map(const std::filesystem::path& path);

/// Implements estampe::is_map_folder().
[[nodiscard]] bool is_folder_name(const std::filesystem::path& path);

/// Implements estampe::save_tonal_art_map().
void write_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Makes a map from painted images: tones from light to dark, each with level 0 and any number of coarser
/// levels; images of one level have equal size. Measures `darkness` if it is empty. `where` names the source
/// in errors.
[[nodiscard]] PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                                      std::vector<float> darkness, const std::string& where);

// A `.tam` file is a zip archive that any archiver opens. It contains `tam.toml` with the size and the
// darknesses, and a PNG per tone and level, `tone1_level0.png` and so on, black ink on white; also the
// thresholds, if the map has them, as `threshold_level0.png`. The same map gives the same bytes.

/// Throws Error if the map is invalid.
[[nodiscard]] std::vector<std::byte> encode_tam(const TonalArtMap& map);

/// Reads the output of encode_tam(), also after an artist has painted over it. Throws Error naming `name` and
/// the entry if anything is missing, damaged, of the wrong size, or beyond the limits of TonalArtMap. Memory
/// stays within a few times that of the largest valid map, whatever the input.
[[nodiscard]] TonalArtMap decode_tam(std::span<const std::byte> bytes, const std::string& name);

/// Writes to a temporary file beside `path`, then renames it. Throws Error.
void save_tam(const TonalArtMap& map, const std::filesystem::path& path);

[[nodiscard]] TonalArtMap load_tam(const std::filesystem::path& path);

[[nodiscard]] std::string manifest_of(const TonalArtMap& map);

/// Contents of `tam.toml`: size, darknesses and whether there are thresholds.
struct Manifest {
    uint32_t size_px = 0;
    std::vector<float> darkness;
    bool has_thresholds = false;
};

/// Throws Error with name:line:column for a mistake in the text.
[[nodiscard]] Manifest parse_manifest(const std::string& text, const std::string& name);

/// "tone1_level0.png"; names count tones from 1.
[[nodiscard]] std::string image_name(size_t tone, size_t level);

/// The layers of a DDS file, each with its mip levels, finest first; as many as the file contains.
struct DdsImages {
    uint32_t size_px = 0;
    std::vector<std::vector<Gray8>> level_of_layer; ///< coverage: black is ink
};

/// Reads an uncompressed DDS file: 8-bit luminance or alpha; 24- or 32-bit colour with masks; or, with a DX10
/// header, R8, RGBA8 or BGRA8. It may be one image, an array (one tone per layer), or a volume (one tone per
/// slice; only level 0 is read, because coarser levels have fewer slices). Throws Error naming `name` if the
/// file has another format, is truncated, is not square, or exceeds the limits of TonalArtMap.
///
/// Source  Microsoft, "Programming Guide for DDS"
[[nodiscard]] DdsImages decode_dds(std::span<const std::byte> bytes, const std::string& name);

/// A DDS file of all tones: an array of R8 images with their own mip levels, black ink on white.
[[nodiscard]] std::vector<std::byte> encode_dds(const TonalArtMap& map);

/// Converts coverage into a picture for painting: ink is black, paper is white.
[[nodiscard]] Image picture_of(const Gray8& coverage, uint32_t size_px);

/// Coverage of a picture: its darkness, with transparent pixels over white.
[[nodiscard]] Gray8 coverage_of(const Image& picture);

/// A square PNG as coverage, and its side. Throws Error naming `name` if the file is not a PNG, is damaged,
/// is not square, or its side is not a power of two or exceeds max_size_px. Checks the size before it
/// allocates memory.
struct Square {
    uint32_t size_px = 0;
    Gray8 coverage;
};

[[nodiscard]] Square decode_square(std::span<const std::byte> png, const std::string& name);

} // namespace estampe::tam
