// SPDX-License-Identifier: MIT
#pragma once

// See-through surfaces (glTF's BLEND) as screened ink: those in front of what is solid, laid over each other,
// tint the wash, pull the darkness of the strokes behind them towards their own by their cover, and are
// outlined. Or as glass: each lit and painted as what is solid is, in order of depth.

#include <array>
#include <optional>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::transparency {

inline constexpr uint32_t most_layers = 4;        ///< of screened ink
inline constexpr uint32_t most_sorted_layers = 8; ///< that are painted one by one

/// A tint on what is behind, or surfaces of their own.
enum class Mode : uint8_t { ink, sorted };

struct TransparencyStyle {
    Mode mode = Mode::ink;
    int layers = most_layers;
};

[[nodiscard]] const style::Table<TransparencyStyle>& transparency_table();

struct TransparencyInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId solid_visibility;
    std::vector<gpu::BufferId> layers; ///< visibility of the blended triangles alone, at least one: of the
                                       ///< nearest, of what lies behind those, and so on
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    uint32_t texture_classes = 0;
    std::optional<gpu::BufferId> tiles; ///< in which the first layer sees anything, see
                                        ///< shaders/tiles.glsl.h
    glm::uvec2 size_px{0};
};

/// A screen over the page, or one blank texel where the scene has nothing to look through.
struct Transparency {
    gpu::ImageId draw;  ///< r32ui: draw + 1, or a number for several draws in their order; 0 for none
    gpu::ImageId color; ///< rgba8: square root of linear colour, cover in alpha
};

/// Lays see-through surfaces over each other, in order of depth, pixel by pixel, `most_layers` of them. Cost:
/// one full-screen dispatch.
///
/// Source  Porter and Duff, "Compositing Digital Images", SIGGRAPH 1984
[[nodiscard]] Transparency add_transparency(gpu::Graph& graph, const TransparencyInputs& in);

/// Lays one of the layers, the farthest first, over the paint of what lies behind it, `wash`, of which it
/// returns the new version. `painted` is the paint of the layer itself. Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_sheet(gpu::Graph& graph, const TransparencyInputs& in, gpu::BufferId layer,
                                     gpu::ImageId painted, gpu::ImageId wash);

/// For scenes without see-through surfaces. Cost: next to nothing.
[[nodiscard]] Transparency add_no_transparency(gpu::Graph& graph);

} // namespace estampe::transparency
