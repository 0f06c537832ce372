// SPDX-License-Identifier: MIT
#pragma once

// Brushes of lines on the GPU: pictures of strokes, one per layer.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

/// A stroke from left to right; its left side is at the top.
struct BrushStrip {
    std::vector<float> ink; ///< brush_rows rows of brush_columns values, 0 for paper, 1 for ink
    float widths = 1.0F;    ///< length of the stroke divided by its width
};

/// The brush of each kind of line.
struct BrushSet {
    std::vector<BrushStrip> strips;
    /// Index into `strips` by kind of line, or shared::brush_hidden; none draws with the pen.
    std::array<std::optional<uint32_t>, shared::brush_use_count> strip_of_use;
};

struct BrushImages {
    gpu::Image strips; ///< r8, one layer per strip
    std::array<std::optional<uint32_t>, shared::brush_use_count> layer_of_use;
    std::array<float, shared::brush_use_count> widths_of_use{};

    /// Whether any kind of seen line has a brush other than the pen.
    [[nodiscard]] bool draw_seen_lines() const
    {
        return std::any_of(layer_of_use.begin(), layer_of_use.begin() + shared::brush_hidden,
                           [](const auto& layer) { return layer.has_value(); });
    }
};

/// `brushes`, or null if the pen draws all seen lines.
[[nodiscard]] inline BrushImages* brushes_of_seen_lines(BrushImages* brushes)
{
    return brushes != nullptr && brushes->draw_seen_lines() ? brushes : nullptr;
}

/// Uploads all strips with mip levels; each texel is the mean of four of the level before. Requires at least
/// one strip. Throws Error when memory runs out.
[[nodiscard]] BrushImages upload_brushes(gpu::Device& device, const BrushSet& brushes);

} // namespace estampe::contour
