// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "techniques/contour/contour_style.hpp"

namespace estampe::contour {

struct BrushImages;

/// The mesh whose crests have lines: a ground that the wind has shaped.
struct CrestMesh {
    uint32_t first_vertex = 0;
    uint32_t vertex_count = 0;   ///< of all meshes; it is the last
    glm::vec2 along{1.0F, 0.0F}; ///< where the wind blows to, over x and z; unit
};

struct ContourInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId materials;
    std::optional<CrestMesh> crests; ///< where lines of chains are wanted along them
    bool own_outlines = false;       ///< some material brings an outline of its own
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::ImageId coordinate;
    gpu::ImageId light;
    std::optional<gpu::ImageId> sun; ///< as light::LitPixels; only where edges of shadows are wanted
    gpu::ImageId screen_draw;        ///< of what is looked through; one texel for none
    bool has_screen = false;
    bool only_cut = false; ///< only what a texture's alpha cuts has lines
    gpu::ExecutionProfile execution;
    bool is_moving = false;         ///< it, or the camera, since the frame before
    BrushImages* brushes = nullptr; ///< of chains; none for the pen alone
    float pixels_per_mm = 1.0F;
    float line_step_px = 3.0F;     ///< between samples of chains, about
    float pixel_m_at_one = 0.001F; ///< what a pixel spans at a distance of one; in parallel projection at any
    glm::uvec2 size_px{0};
    std::optional<gpu::BufferId> look_of_draw; ///< where surfaces differ: r32ui texels
    std::optional<gpu::BufferId> line_looks;   ///< then, LineLook of each look; chains alone heed them
    /// Visibility of what hides lines of chains, where that is not all that is solid: clear glass does not.
    std::optional<gpu::BufferId> line_hiders;
};

/// How far off the seeds lie that the lines at a pixel hang on, where lines are found between pixels.
[[nodiscard]] uint32_t reach_px(const ContourStyle& style, float pixels_per_mm);

/// Draws lines in screen space: breaks of identity, depth and normal become seeds, placed where the front
/// triangle ends; jump flooding gives every pixel its nearest seed, and with it an antialiased line of any
/// width.
///
/// Writes  rgba8: square root of the ink's linear colour; coverage in alpha, 0 paper to 1 ink
/// Cost    two full-screen dispatches, and one for each doubling of the width
/// Source  Saito and Takahashi, "Comprehensible Rendering of 3-D Shapes", 1990; Rong and Tan, "Jump
/// Flooding", 2006
[[nodiscard]] gpu::ImageId add_contours(gpu::Graph& graph, const ContourInputs& in,
                                        const ContourStyle& style);

} // namespace estampe::contour
