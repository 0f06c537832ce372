// SPDX-License-Identifier: MIT
#pragma once

// See-through surfaces (glTF's BLEND) as screened ink: those in front of what is solid, laid over each other,
// tint the wash, pull the darkness of the strokes behind them towards their own by their cover, and are
// outlined.

#include <array>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::screen {

inline constexpr uint32_t most_layers = 4;

struct ScreenStyle {
    int layers = most_layers;
};

inline const style::Table<ScreenStyle>& screen_table()
{
    static const auto table =
        style::Table<ScreenStyle>("screen", "What is looked through")
            .integer("layers", &ScreenStyle::layers, {1, most_layers}, "",
                     "See-through surfaces of a pixel that count, the nearest first; each one costs a pass, "
                     "where the scene has as many");
    return table;
}

struct ScreenInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId solid_visibility;
    std::vector<gpu::BufferId> layers; ///< visibility of the blended triangles alone, 1 to `most_layers`: of
                                       ///< the nearest, of what lies behind those, and so on
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    uint32_t texture_classes = 0;
    glm::uvec2 size_px{0};
};

/// A screen over the page, or one blank texel where the scene has nothing to look through.
struct Screen {
    gpu::ImageId draw;  ///< r32ui: draw + 1, or a number for several draws in their order; 0 for none
    gpu::ImageId color; ///< rgba8: square root of linear colour, cover in alpha
};

/// Lays see-through surfaces over each other, in order of depth, pixel by pixel. Cost: one full-screen
/// dispatch.
///
/// Source  Porter and Duff, "Compositing Digital Images", SIGGRAPH 1984
[[nodiscard]] Screen add_screen(gpu::Graph& graph, const ScreenInputs& in);

/// For scenes without see-through surfaces. Cost: next to nothing.
[[nodiscard]] Screen add_no_screen(gpu::Graph& graph);

} // namespace estampe::screen
