// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/image.hpp>

#include "core/picture_bytes.hpp"

namespace estampe {

/// Decodes the flattened picture of a PSD file, RGB with 8 or 16 bits per channel; a fourth channel is alpha.
/// Throws Error with `name` as its place when the data is damaged or of another kind.
[[nodiscard]] Image decode_psd(const PictureBytes& bytes, const std::string& name);

} // namespace estampe
