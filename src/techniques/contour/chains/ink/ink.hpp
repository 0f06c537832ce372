// SPDX-License-Identifier: MIT
#pragma once

// Brushes of lines on the device: pictures of strokes, one a layer.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe::contour {

/// A stroke from left to right, its left side at the top.
struct BrushStrip {
    std::vector<float> ink; ///< shared::brush_rows rows of shared::brush_columns, 0 paper to 1
    float widths = 1.0F;    ///< how many times it is as long as it is wide
};

/// Which brush each kind of line has.
struct BrushSet {
    std::vector<BrushStrip> strips;
    /// By kind of line and shared::brush_hidden, into `strips`; none for the pen.
    std::array<std::optional<uint32_t>, shared::brush_use_count> strip_of_use;
};

struct BrushImages {
    gpu::Image strips; ///< r8, a layer a strip
    std::array<std::optional<uint32_t>, shared::brush_use_count> layer_of_use;
    std::array<float, shared::brush_use_count> widths_of_use{};

    /// Whether what is seen has others than the pen.
    [[nodiscard]] bool draw_seen_lines() const
    {
        return std::any_of(layer_of_use.begin(), layer_of_use.begin() + shared::brush_hidden,
                           [](const auto& layer) { return layer.has_value(); });
    }
};

/// For what is seen: none where the pen alone draws that.
[[nodiscard]] inline BrushImages* brushes_of_seen_lines(BrushImages* brushes)
{
    return brushes != nullptr && brushes->draw_seen_lines() ? brushes : nullptr;
}

/// Uploads all strips with their levels, each the mean of four texels of the one before. There is at least
/// one strip. Throws Error when memory runs out.
[[nodiscard]] BrushImages upload_brushes(gpu::Device& device, const BrushSet& brushes);

} // namespace estampe::contour
