// SPDX-License-Identifier: MIT
#pragma once

// Tonal art maps in files: `.tam` archives, DDS files, and folders of images.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

using estampe::PaintedMap;

/// As estampe::load_tonal_art_map(). Where levels are missing, see painted_strokes.hpp.
[[nodiscard]] PaintedMap read_map(const std::filesystem::path& path);

/// As estampe::is_map_folder().
[[nodiscard]] bool is_folder_name(const std::filesystem::path& path);

/// As estampe::save_tonal_art_map().
void write_map(const TonalArtMap& map, const std::filesystem::path& path);

/// Makes a map of images as they were painted: tones from light to dark, in each level 0 and any number of
/// coarser ones, those of one level as large. `darkness` is measured where it is empty. `where` is for
/// errors.
[[nodiscard]] PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                                      std::vector<float> darkness, const std::string& where);

// A `.tam` file is a zip archive that any archiver opens: `tam.toml`, which names size and darknesses, and a
// PNG a tone and level, `tone1_level0.png` and so on, black ink on white; with the thresholds, where the map
// has them, as `threshold_level0.png`. The same map gives the same bytes.

/// Throws Error when the map is not sound.
[[nodiscard]] std::vector<std::byte> encode_tam(const TonalArtMap& map);

/// Reads what encode_tam() writes, and what an artist has painted over in it. Throws Error naming `name` and
/// the entry when anything is missing, damaged, of another size, or beyond the limits of TonalArtMap. Memory
/// stays within a few times that of the largest map allowed, whatever the bytes say.
[[nodiscard]] TonalArtMap decode_tam(std::span<const std::byte> bytes, const std::string& name);

/// Writes beside `path` first and renames. Throws Error.
void save_tam(const TonalArtMap& map, const std::filesystem::path& path);

[[nodiscard]] TonalArtMap load_tam(const std::filesystem::path& path);

/// The text of `tam.toml`.
[[nodiscard]] std::string manifest_of(const TonalArtMap& map);

/// Size, darknesses and whether there are thresholds, as `tam.toml` says.
struct Manifest {
    uint32_t size_px = 0;
    std::vector<float> darkness;
    bool has_thresholds = false;
};

/// Throws Error with name:line:column for a mistake in the text.
[[nodiscard]] Manifest parse_manifest(const std::string& text, const std::string& name);

/// "tone1_level0.png"; tones count from 1 in names.
[[nodiscard]] std::string image_name(size_t tone, size_t level);

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

/// A coverage as a picture that can be painted on: ink black, paper white.
[[nodiscard]] Image picture_of(const Gray8& coverage, uint32_t size_px);

/// The coverage of a picture: how dark it is, on white where it is transparent.
[[nodiscard]] Gray8 coverage_of(const Image& picture);

/// A square PNG as coverage, and its side. Throws Error with `name` as its place when it is no PNG, damaged,
/// not square, or its side is no power of two or beyond max_size_px; nothing of that size is allocated
/// before.
struct Square {
    uint32_t size_px = 0;
    Gray8 coverage;
};

[[nodiscard]] Square decode_square(std::span<const std::byte> png, const std::string& name);

} // namespace estampe::tam
