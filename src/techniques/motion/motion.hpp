// SPDX-License-Identifier: MIT
#pragma once

// Motion vectors: how far the visible surface at each pixel has moved on the page since another moment.

#include "gpu/graph/graph.hpp"
#include "techniques/motion/motion.glsl.h"

namespace estampe::motion {

struct MotionInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    /// Posed vertices at the other moment; the same buffer as `posed_vertices` if nothing moved.
    gpu::BufferId posed_vertices_before;
    glm::mat4 clip_from_anchor{1.0F}; ///< camera of the current frame, without subpixel antialiasing shift
    glm::mat4 clip_from_anchor_before{1.0F};
    glm::uvec2 size_px{0};
};

/// Computes the exact motion of the surface at each pixel: interpolates the vertices of the visible triangle
/// as posed at the other moment. The background moves as if it were infinitely far away.
///
/// Writes  rgba32f: motion in pixels to the right and down; reversed depth of the point at the other moment
///         (0 at infinity); and 1 if the motion is known, 0 if the point was behind the eye. If the picture
///         of the other moment has another depth at the point's place, the point was hidden at the other
///         moment
/// Cost    one full-screen dispatch that gathers three vertices twice per pixel and writes 16 bytes per pixel
[[nodiscard]] gpu::ImageId add_motion(gpu::Graph& graph, const MotionInputs& in);

} // namespace estampe::motion
