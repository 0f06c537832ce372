// SPDX-License-Identifier: MIT
#pragma once

// Serialises a scene to pass it from the child process that read the file to the parent.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/pictures/picture_files.hpp"

namespace estampe {

/// A scene whose textures are not decoded yet. `images` has one entry per texture.
struct TransferScene {
    Scene scene;
    std::vector<ImageSource> images;
};

[[nodiscard]] std::vector<std::byte> pack(const TransferScene& transfer);

/// Deserialises a scene that pack() has serialised. Throws Error, with `where` as its place, when the bytes
/// end too early, when a count is larger than the number of bytes that follow, or when an enumeration has an
/// unknown value. Does not check whether indices are in range or numbers are finite.
[[nodiscard]] TransferScene unpack(std::span<const std::byte> bytes, const std::string& where);

} // namespace estampe
