// SPDX-License-Identifier: MIT
#pragma once

// What passes over the lines of strokes share.

#include "techniques/hatch/hatch.glsl.h"
#include "techniques/hatch/hatch.hpp"

namespace estampe::hatch {

[[nodiscard]] shared::LineConstants line_constants(const HatchInputs& in, const HatchStyle& style);

/// Bits of line_families.glsl, without that of the tiles.
[[nodiscard]] uint32_t line_variant(const HatchInputs& in, const HatchStyle& style);

/// For each pixel the nearest one with strokes, as far as they run over; the draw image where they do not.
[[nodiscard]] gpu::ImageId add_overrun(gpu::Graph& graph, const HatchInputs& in, gpu::ImageId darkness,
                                       const HatchStyle& style);

} // namespace estampe::hatch
