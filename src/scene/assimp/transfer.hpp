// SPDX-License-Identifier: MIT
#pragma once

// A scene on its way from the process that read the file.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/pictures/picture_files.hpp"

namespace estampe {

/// A scene whose textures have no pictures yet; `images` has one entry per texture.
struct TransferScene {
    Scene scene;
    std::vector<ImageSource> images;
};

[[nodiscard]] std::vector<std::byte> pack(const TransferScene& transfer);

/// The inverse of pack(). Throws Error, with `where` as its place, when the bytes end early, when a count is
/// larger than what follows, or when an enumeration has a value it does not know. Indices and numbers are not
/// looked at.
[[nodiscard]] TransferScene unpack(std::span<const std::byte> bytes, const std::string& where);

} // namespace estampe
