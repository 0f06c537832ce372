// SPDX-License-Identifier: MIT
#pragma once

// Smudge: soft edges of dry strokes, and pigment that is rubbed from the strokes over the paper around them,
// as a finger or a paper stump does with pencil, chalk and charcoal.

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::smudge {

struct SmudgeStyle {
    float soft_mm = 0.0F;
    float strength = 0.0F;
    float width_mm = 2.5F;
};

[[nodiscard]] const style::Table<SmudgeStyle>& smudge_table();

/// Whether the style changes any layer.
[[nodiscard]] bool is_on(const SmudgeStyle& style);

/// The layers of a drawing that are smudged.
struct SmudgeLayers {
    gpu::ImageId wash;  ///< rgba16f: flat colour under the ink
    gpu::ImageId hatch; ///< r16f: ink of strokes
    gpu::ImageId lines; ///< rgba8: square roots of the lines' colour, coverage in alpha
};

struct SmudgeInputs {
    glm::vec3 ink{0.0F}; ///< linear colour of the rubbed pigment
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0}; ///< size of the page, or of the current tile of the page
    glm::uvec2 from_px{0}; ///< position of the tile on the page
};

/// Largest distance in pixels from which strokes and lines affect a pixel; 0 if the style changes nothing.
[[nodiscard]] uint32_t reach_px(const SmudgeStyle& style, float pixels_per_mm);

/// Softens the edges of strokes and lines, and rubs a share of the strokes' ink into the wash. The mean ink
/// of an evenly hatched area does not change.
///
/// Writes  new versions of the three layers; if the style changes nothing, declares nothing and returns
///         `layers` itself
/// Cost    two full-screen dispatches with 4 and 2 texels per pixel for each pixel of `soft_mm`; for rubbing,
///         one more that reads a texel per pixel, and two over cells a quarter of `width_mm` wide
[[nodiscard]] SmudgeLayers add_smudge(gpu::Graph& graph, const SmudgeInputs& in, const SmudgeStyle& style,
                                      const SmudgeLayers& layers);

} // namespace estampe::smudge
