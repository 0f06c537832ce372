// SPDX-License-Identifier: MIT
#pragma once

// Picture formats that textures of FBX, DAE and OBJ files are often in: TGA, BMP, GIF and PSD.

#include <optional>
#include <span>
#include <string>

#include <estampe/image.hpp>

namespace estampe {

/// Decodes a TGA, BMP or GIF (its first frame) with stb_image, or the flattened picture of a PSD; nothing
/// when the data is none of these. Told apart by content: TGA has no magic number, so its header has to be
/// sound in every field. Throws Error with `name` as its place when the data is cut short, damaged or of an
/// unusual kind: stb_image itself would take missing bytes for zeros.
[[nodiscard]] std::optional<Image> decode_older_picture(std::span<const std::byte> data,
                                                        const std::string& name);

} // namespace estampe
