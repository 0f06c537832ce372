// SPDX-License-Identifier: MIT
#pragma once

// How pigment moves over the paper. Dry pigment of pencil, chalk and charcoal has soft edges, and a finger or
// a paper stump rubs it over the paper. Wet paint strays beyond the lines that it fills, and pools at its
// edges.

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::pigment {

struct PigmentStyle {
    float soft_mm = 0.0F;
    float rub = 0.0F;
    float rub_mm = 2.5F;
    float pool = 0.0F;
    float pool_mm = 2.0F;
    float wet = 0.0F;
    float stray_mm = 0.0F;
    int seed = 1; ///< value of drawing.seed
};

[[nodiscard]] const style::Table<PigmentStyle>& pigment_table();

/// Whether the style changes any layer.
[[nodiscard]] bool is_on(const PigmentStyle& style);

/// The layers of a drawing whose pigment moves.
struct PigmentLayers {
    gpu::ImageId
        wash; ///< rgba16f: flat colour under the ink, as the share of light that the paint lets through
    gpu::ImageId hatch; ///< r16f: ink of strokes
    gpu::ImageId lines; ///< rgba8: square roots of the lines' colour, coverage in alpha
};

struct PigmentInputs {
    glm::vec3 ink{0.0F}; ///< linear colour of the rubbed pigment
    float pixels_per_mm = 1.0F;
    glm::uvec2 size_px{0}; ///< size of the page, or of the current tile of the page
    glm::uvec2 from_px{0}; ///< position of the tile on the page
};

/// Largest distance in pixels from which other pixels affect a pixel; 0 if the style changes nothing.
[[nodiscard]] uint32_t reach_px(const PigmentStyle& style, float pixels_per_mm);

/// Lets paint stray and pool, softens the edges of strokes and lines, and rubs a share of the strokes' ink
/// into the wash. Rubbing does not change the mean ink of an evenly hatched area, and pooling does not change
/// the colour of an even area.
///
/// Writes  new versions of the layers that change; layers that the style does not change are returned
///         themselves, without any pass
/// Cost    for strokes and lines: two full-screen dispatches with 5 and 2.5 texels per pixel for each pixel
/// of
///         `soft_mm`. For paint: one full-screen dispatch. For each of rubbing and pooling, one more that
///         reads a texel per pixel, and two over cells with sides of a quarter of `rub_mm` or `pool_mm`
[[nodiscard]] PigmentLayers add_pigment(gpu::Graph& graph, const PigmentInputs& in, const PigmentStyle& style,
                                        const PigmentLayers& layers);

} // namespace estampe::pigment
