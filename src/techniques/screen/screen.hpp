// SPDX-License-Identifier: MIT
#pragma once

// See-through surfaces (glTF's BLEND) as screened ink: the nearest one in front of what is solid tints the
// wash, pulls the darkness of the strokes behind it towards its own by its cover, and is outlined.

#include <array>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"

namespace estampe::screen {

struct ScreenInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId solid_visibility;
    gpu::BufferId screen_visibility; ///< of the blended triangles alone
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
    gpu::ImageId draw;  ///< r32ui: draw + 1, 0 for none
    gpu::ImageId color; ///< rgba8: square root of linear colour, cover in alpha
};

/// Cost: one full-screen dispatch. Order among see-through surfaces is by depth, pixel by pixel: only the
/// nearest counts.
[[nodiscard]] Screen add_screen(gpu::Graph& graph, const ScreenInputs& in);

/// For scenes without see-through surfaces. Cost: one thread.
[[nodiscard]] Screen add_no_screen(gpu::Graph& graph);

} // namespace estampe::screen
