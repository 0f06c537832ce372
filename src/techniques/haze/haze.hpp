// SPDX-License-Identifier: MIT
#pragma once

// Air between the eye and what is far: colour fades into the sky's, strokes and lines into nothing.

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
};

[[nodiscard]] const style::Table<HazeStyle>& haze_table();

struct HazeInputs {
    gpu::BufferId frame;       ///< FrameGlobals
    gpu::ImageId depth;        ///< r32f: reversed, 0 where nothing is
    float line_half_px = 1.0F; ///< of the widest line: what of it lies beyond the edge it follows
    glm::uvec2 size_px{0};
    /// Then these alone are faded, as of surface::add_far_tiles() from where haze starts.
    std::optional<gpu::BufferId> tiles;
};

/// What fades.
struct HazeLayers {
    gpu::ImageId wash;  ///< rgba16f
    gpu::ImageId hatch; ///< r16f
    gpu::ImageId lines; ///< rgba8, coverage in alpha
};

/// Fades what is far, into `sky`, an rgba16f as large as the page or of one texel.
///
/// Writes  new versions of the three layers; where nothing is seen, they keep their bytes
/// Cost    one dispatch, over the page or a list of tiles; on pixels of lines 64 depths besides at most
[[nodiscard]] HazeLayers add_haze(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style,
                                  gpu::ImageId sky, const HazeLayers& layers);

/// How much ink is left at each pixel of what is drawn, for strokes as paths.
///
/// Writes  two floats a pixel, row by row: of strokes, of lines; 1 where nothing is seen
/// Cost    one full-screen dispatch of 64 depths a pixel at most
[[nodiscard]] gpu::BufferId add_ink_left(gpu::Graph& graph, const HazeInputs& in, const HazeStyle& style);

} // namespace estampe::haze
