// SPDX-License-Identifier: MIT
#pragma once

// The tree of named elements in a binary or text FBX file. Assimp reads meshes, materials and animations from
// such a file, but drops data of cameras, pivots and axes. This reader collects the dropped data.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace estampe::fbx {

using Value = std::variant<int64_t, double, std::string>;

struct Element {
    std::string name;
    std::vector<Value> values;     ///< numbers and texts; arrays are left out
    size_t first_text_at = 0;      ///< byte offset in the file of the first text among `values`
    std::vector<Element> children; ///< in the file's order
};

struct Tree {
    uint32_t version = 0; ///< 7400 is FBX 7.4; 0 means that the file does not say
    std::vector<Element> elements;
};

/// Version of the FBX file that begins with `head` (its first kilobytes suffice); 0 if the file does not say.
[[nodiscard]] uint32_t file_version(std::span<const char> head);

/// Reads the settings, the objects of kind Model, NodeAttribute and AnimationStack, and their connections;
/// skips everything else. Throws Error without a place when the file is damaged. Memory stays within a
/// multiple of the file's size, and the depth of nesting is limited.
[[nodiscard]] Tree read_tree(std::span<const char> file);

/// Throws Error naming the file if its version is below 7.1, because such files have another structure.
void check_version(const std::filesystem::path& path);

} // namespace estampe::fbx
