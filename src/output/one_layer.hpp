// SPDX-License-Identifier: MIT
#pragma once

// A layer or a mask of a picture, looked at alone.

#include <string>

#include <estampe/layers.hpp>

namespace estampe::output {

/// The layer of that name on white, or what its mask leaves of white. Throws Error naming those that there
/// are when none has it, and as flattened() does.
[[nodiscard]] LinearImage one_layer(const LayeredImage& image, const std::string& name);

/// In bytes, sRGB-encoded.
[[nodiscard]] Image encoded_bytes(const LinearImage& image);

} // namespace estampe::output
