// SPDX-License-Identifier: MIT
#pragma once

// Haze: with distance, colour fades into the colour of the sky, and strokes and lines fade to nothing.

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::haze {

struct HazeStyle {
    style::AutoToggle enabled = style::AutoToggle::automatic;
    float start_m = 80.0F;
    float reach_m = 700.0F;
    float ink = 3.0F;
    float tint = 0.0F;
    glm::vec3 tint_color = style::srgb(0xf0dca2);
    float tint_distance_m = 120.0F;
    float hatching = 1.0F;
    float hatching_distance_m = 60.0F;
};

[[nodiscard]] const style::Table<HazeStyle>& haze_table();

struct HazeInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId depth;  ///< r32f: reversed depth; 0 is the background
    /// Half the width of the widest line: the part of the line outside the edge that the line follows.
    float line_half_px = 1.0F;
    glm::uvec2 size_px{0};
    /// Tiles to fade, from surface::add_far_tiles() beyond start_m; empty: the whole page.
    std::optional<gpu::BufferId> tiles;
};

/// The layers of the drawing that fade.
struct HazeLayers {
    gpu::ImageId wash;  ///< rgba16f: flat colour under the ink
    gpu::ImageId hatch; ///< r16f: ink of strokes
    gpu::ImageId lines; ///< rgba8: contour lines, coverage in alpha
};

/// Adds a pass that fades distant parts into `sky`, an rgba16f image of the page's size or of one texel.
///
/// Writes  new versions of the three layers; background pixels are unchanged
/// Cost    one dispatch over the page or a list of tiles; up to 64 more depth samples on pixels of lines
[[nodiscard]] HazeLayers add_haze(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style,
                                  gpu::ImageId sky, const HazeLayers& layers);

/// Adds a pass that computes the share of ink that haze leaves at each pixel, for strokes drawn as vector
/// paths.
///
/// Writes  two floats per pixel, row by row: for strokes and for lines; 1 on the background
/// Cost    one full-screen dispatch with at most 64 depth samples per pixel
[[nodiscard]] gpu::BufferId add_ink_left(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style);

} // namespace estampe::haze
