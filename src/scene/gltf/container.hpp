// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace estampe::gltf {

/// The two parts of a glTF file: the JSON text, and for .glb the binary chunk.
struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
    bool is_binary = false;
    size_t json_offset = 0; ///< where the JSON text begins in the file
};

/// The bytes of a glTF file, and none of what lies behind: its first bytes are looked at before the rest is
/// read, so that a large file of something else is refused at once. Throws Error as open_container() does.
[[nodiscard]] std::vector<std::byte> read_gltf_bytes(const std::filesystem::path& path);

/// Takes a file apart without copying; the result points into `bytes`. Throws Error with a byte offset when
/// it is empty, truncated, of another version, or no glTF at all, and when the JSON is nested deeper than 256
/// levels.
[[nodiscard]] Container open_container(std::span<const std::byte> bytes, const std::string& file);

/// "file:line:column" for text, "file:byte N" for binary.
[[nodiscard]] std::string place_in_json(const Container& container, const std::string& file,
                                        size_t json_byte);

} // namespace estampe::gltf
