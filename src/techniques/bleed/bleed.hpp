// SPDX-License-Identifier: MIT
#pragma once

// Ink that runs a little: strokes and contours of different things melt into each other where they meet.

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
    gpu::ImageId hatch; ///< r16f: ink of the strokes
    gpu::ImageId lines; ///< rgba8: ink of the lines, coverage in alpha
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
};

/// How far off the ink lies that the ink of a pixel hangs on.
[[nodiscard]] uint32_t reach_px(const BleedStyle& style, float pixels_per_mm);

/// Lets the ink of strokes and lines run together: blur and contrast, which fills acute corners and narrow
/// gaps and takes nothing away.
///
/// Writes  r16f: what replaces `hatch` under the same lines, which keep their colour; never less than
/// `hatch`.
///         With a width of 0 nothing is declared, and `hatch` itself is handed back.
/// Cost    two full-screen dispatches, of at most 386 and 195 texels a pixel: 98 and 51 up to a width of 19
/// px
[[nodiscard]] gpu::ImageId add_bleed(gpu::Graph& graph, const BleedInputs& in, const BleedStyle& style);

} // namespace estampe::bleed
