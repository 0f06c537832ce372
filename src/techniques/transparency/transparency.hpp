// SPDX-License-Identifier: MIT
#pragma once

// Transparent surfaces (glTF's BLEND), in one of two modes. In the mode `ink`, the surfaces in front of solid
// ones are composited into one colour and outlined. The composited surfaces colour the wash, and move the
// darkness of the strokes behind them towards their own darkness, in proportion to their coverage. In the
// mode `sorted`, each surface is lit and painted like a solid one, in depth order.

#include <array>
#include <optional>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::transparency {

inline constexpr uint32_t most_layers = 4;        ///< most layers that are composited in the mode `ink`
inline constexpr uint32_t most_sorted_layers = 8; ///< most layers that are painted in the mode `sorted`

/// How transparent surfaces are drawn: composited into one colour over the wash (ink), or painted one by one
/// in depth order (sorted).
enum class Mode : uint8_t { ink, sorted };

struct TransparencyStyle {
    Mode mode = Mode::ink;
    int layers = most_layers;
    float opaque_above = 1.0F;
};

/// Whether the style draws the parts of transparent surfaces that are nearly opaque as solid surfaces.
[[nodiscard]] inline bool has_opaque_parts(const TransparencyStyle& style)
{
    return style.opaque_above < 1.0F;
}

[[nodiscard]] const style::Table<TransparencyStyle>& transparency_table();

struct TransparencyInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::BufferId solid_visibility;
    /// Visibility buffers of transparent triangles, at least one: the nearest surfaces, the surfaces behind
    /// them, and so on.
    std::vector<gpu::BufferId> layers;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    uint32_t texture_classes = 0;
    /// List of the tiles in which the first layer has surfaces, see shaders/tiles.glsl.h.
    std::optional<gpu::BufferId> tiles;
    glm::uvec2 size_px{0};
};

/// The composited transparent surfaces; images of one blank texel if the scene has none.
struct Transparency {
    gpu::ImageId draw; ///< r32ui: draw call + 1, or an identifier of several draw calls in depth order; 0: no
                       ///< transparent surface
    gpu::ImageId color; ///< rgba8: square root of linear colour, coverage in alpha
};

/// Adds a pass that composites transparent surfaces in depth order, per pixel, at most `most_layers` of them.
/// Cost: one full-screen dispatch.
///
/// Source  Porter and Duff, "Compositing Digital Images", SIGGRAPH 1984
[[nodiscard]] Transparency add_transparency(gpu::Graph& graph, const TransparencyInputs& in);

/// Adds a pass that blends one transparent layer over `wash`, the paint behind it, and returns the new
/// version of `wash`. Call add_sheet() for the farthest layer first. `painted` is the layer's own paint.
/// Cost: one full-screen dispatch.
[[nodiscard]] gpu::ImageId add_sheet(gpu::Graph& graph, const TransparencyInputs& in, gpu::BufferId layer,
                                     gpu::ImageId painted, gpu::ImageId wash);

/// Makes the blank result for scenes without transparent surfaces. Costs next to nothing.
[[nodiscard]] Transparency add_no_transparency(gpu::Graph& graph);

} // namespace estampe::transparency
