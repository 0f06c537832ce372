// SPDX-License-Identifier: MIT
#pragma once

// Ink bleed: strokes and contours of neighbouring objects merge where they meet.

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::bleed {

struct BleedStyle {
    bool enabled = false;
    float width_mm = 0.25F;
    float contrast = 6.0F;
    float level = 0.45F;
};

[[nodiscard]] const style::Table<BleedStyle>& bleed_table();

struct BleedInputs {
    gpu::ImageId hatch;      ///< r16f: ink of the strokes
    gpu::ImageId lines;      ///< rgba8: ink of the lines, coverage in alpha
    bool strokes_run = true; ///< false for a screentone, whose dots are printed and keep their shape
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
};

/// Largest distance from which ink of other pixels affects a pixel by bleeding; 0 if bleed is off.
[[nodiscard]] uint32_t reach_px(const BleedStyle& style, float pixels_per_mm);

/// Merges the ink of strokes and lines by blur and contrast. Bleeding fills acute corners and narrow gaps,
/// and removes no ink.
///
/// Writes  r16f: replaces `hatch` below the same lines, which keep their colour; never less than `hatch`.
///         If bleed is off, declares nothing and returns `hatch` itself
/// Cost    two full-screen dispatches with at most 386 and 195 texels per pixel; 98 and 51 up to a width
///         of 19 px
[[nodiscard]] gpu::ImageId add_bleed(gpu::Graph& graph, const BleedInputs& in, const BleedStyle& style);

} // namespace estampe::bleed
