// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// A `.tam` file is a zip archive that any archiver opens: `tam.toml`, which names size and darknesses, and a
/// PNG a tone and level, `tone1_level0.png` and so on, black ink on white; with the thresholds, where the map
/// has them, as `threshold_level0.png`. The same map gives the same bytes.

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

} // namespace estampe::tam
