// SPDX-License-Identifier: MIT
#pragma once

// What the shaders of slabs are told: a style in whole numbers.

#include "techniques/terrain/slabs/slabs.glsl.h"
#include "techniques/terrain/slabs/slabs.hpp"

namespace estampe::terrain {

/// Of a step, whose wind is one of those within the spread.
[[nodiscard]] shared::SlabConstants slab_constants(const SlabStyle& style, uint32_t side, uint64_t step);

/// Of one of a step's slides.
[[nodiscard]] shared::SlideConstants slide_constants(const SlabStyle& style, uint32_t side, int slide);

} // namespace estampe::terrain
