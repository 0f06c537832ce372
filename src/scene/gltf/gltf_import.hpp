// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads a glTF 2.0 file, text or binary (told apart by content), with the buffers and images it names beside
/// it.
///
/// Throws Error with the place as `file#/json/pointer`, `file:line:column` or `file:byte N`. Missing or
/// corrupt textures, bad normals and the like are repaired and listed in Scene::warnings. Allocates at most a
/// few hundred times the size of the files read, plus the decoded textures. Source: Khronos, "glTF 2.0
/// Specification", 2021.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path);

/// The same from memory. Buffers and images in other files are an Error, respectively a warning. `name`
/// stands for the file in messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name);

} // namespace estampe
