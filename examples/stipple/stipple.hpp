// SPDX-License-Identifier: MIT
#pragma once

// Draws tone as dots: the darker the tone, the larger the dots.

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::stipple {

struct StippleStyle {
    float spacing_mm = 0.7F;
    float jitter = 0.25F;
};

inline const style::Table<StippleStyle>& stipple_table()
{
    static const auto table = style::Table<StippleStyle>("stipple", "Dots that carry the tone")
                                  .number("spacing_mm", &StippleStyle::spacing_mm, {0.1F, 20.0F}, "mm",
                                          "From dot to dot on the page")
                                  .number("jitter", &StippleStyle::jitter, {0.0F, 0.5F}, "",
                                          "How far dots lie off a grid, in its cells");
    return table;
}

struct StippleInputs {
    gpu::ImageId darkness; ///< r16f: 0 is paper, 1 is ink
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0};
};

/// Draws dots whose mean ink equals `darkness`, up to about a half. Above that, dots overlap, so the mean ink
/// is less.
///
/// Writes  r16f: ink of the dots
/// Cost    one full-screen dispatch with 9 texel reads per pixel
[[nodiscard]] gpu::ImageId add_stipple(gpu::Graph& graph, const StippleInputs& in, const StippleStyle& style);

} // namespace estampe::stipple
