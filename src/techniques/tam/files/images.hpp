// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>

#include "techniques/tam/tonal_art_map.hpp"

namespace estampe::tam {

/// A coverage as a picture that can be painted on: ink black, paper white.
[[nodiscard]] Image picture_of(const Gray8& coverage, uint32_t size_px);

/// The coverage of a picture: how dark it is, on white where it is transparent.
[[nodiscard]] Gray8 coverage_of(const Image& picture);

/// A square PNG as coverage, and its side. Throws Error with `name` as its place when it is no PNG, damaged,
/// not square, or its side is no power of two or beyond max_size_px; nothing of that size is allocated
/// before.
struct Square {
    uint32_t size_px = 0;
    Gray8 coverage;
};

[[nodiscard]] Square decode_square(std::span<const std::byte> png, const std::string& name);

} // namespace estampe::tam
