// SPDX-License-Identifier: MIT
#pragma once

// Brushes of lines on the GPU. A brush is a picture of one stroke and takes one layer of an image array.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

/// The picture of a stroke that runs from left to right. The left side of the stroke, seen in drawing
/// direction, is at the top of the picture.
struct BrushStrip {
    std::vector<float> ink; ///< brush_rows rows of brush_columns values: 0 is paper, 1 is full ink
    float widths = 1.0F;    ///< length of the stroke, in multiples of the stroke's width
};

/// The brush that each kind of line uses.
struct BrushSet {
    std::vector<BrushStrip> strips;
    /// Index into `strips` for each kind of line, and for hidden lines (shared::brush_hidden). A kind of line
    /// without an index is drawn with the pen, as a plain line.
    std::array<std::optional<uint32_t>, shared::brush_use_count> strip_of_use;
};

struct BrushImages {
    gpu::Image strips; ///< image array in format r8, one layer per picture of a stroke
    std::array<std::optional<uint32_t>, shared::brush_use_count> layer_of_use;
    std::array<float, shared::brush_use_count> widths_of_use{};

    /// Whether any kind of visible line has a brush other than the pen.
    [[nodiscard]] bool draw_seen_lines() const
    {
        return std::any_of(layer_of_use.begin(), layer_of_use.begin() + shared::brush_hidden,
                           [](const auto& layer) { return layer.has_value(); });
    }
};

/// Returns `brushes`, or null if the pen draws all visible lines.
[[nodiscard]] inline BrushImages* brushes_of_seen_lines(BrushImages* brushes)
{
    return brushes != nullptr && brushes->draw_seen_lines() ? brushes : nullptr;
}

/// Uploads all pictures of strokes with mip levels. A texel of a mip level is the mean of four texels of the
/// finer level. `set` must have at least one picture. Throws Error when memory runs out.
[[nodiscard]] BrushImages upload_brushes(gpu::Device& device, const BrushSet& brushes);

} // namespace estampe::contour
