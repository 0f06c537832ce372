// SPDX-License-Identifier: MIT
#pragma once

// The tree of named elements in a binary or text FBX file. Assimp reads meshes, materials and animations from
// an FBX file, but leaves out data of cameras, pivots and axes. The functions below read the data that Assimp
// leaves out.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <estampe/read_scope.hpp>

namespace estampe::fbx {

using Value = std::variant<int64_t, double, std::string>;

struct Element {
    std::string name;
    std::vector<Value> values;     ///< numbers and texts of the element; arrays are left out
    size_t first_text_at = 0;      ///< byte offset in the file of the first text among `values`
    std::vector<Element> children; ///< child elements in the order of the file
};

struct Tree {
    /// Version of the FBX format: 7400 is FBX 7.4; 0: the file does not state its version.
    uint32_t version = 0;
    std::vector<Element> elements;
};

/// Returns the version of an FBX file. `head` holds the first bytes of the file; a few kilobytes suffice.
/// Returns 0 if the file does not state its version.
[[nodiscard]] uint32_t file_version(std::span<const char> head);

/// Reads from an FBX file the settings, the objects of type Model, NodeAttribute and AnimationStack, and
/// their connections. Skips all other elements. Throws Error without a place when the file is damaged. Memory
/// is at most a multiple of the file's size, and the nesting depth is limited.
[[nodiscard]] Tree read_tree(std::span<const char> file);

/// Throws Error naming the file if the FBX version is below 7.1, because older files have another structure.
void check_version(const std::filesystem::path& path, const ReadScope& scope = {});

} // namespace estampe::fbx
