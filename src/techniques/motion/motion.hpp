// SPDX-License-Identifier: MIT
#pragma once

// How far what is seen at each pixel has moved on the page since another moment: for effects that look back.

#include "gpu/graph/graph.hpp"
#include "techniques/motion/motion.glsl.h"

namespace estampe::motion {

struct MotionInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId posed_vertices_before; ///< the same where nothing moved
    glm::mat4 clip_from_anchor{1.0F};    ///< not jittered
    glm::mat4 clip_from_anchor_before{1.0F};
    glm::uvec2 size_px{0};
};

/// The motion of the surface at each pixel, exact: the point of the triangle that is seen is looked up in the
/// vertices of that moment. Of the background, as of what is infinitely far.
///
/// Writes  rgba32f: pixels to the right and down since then; the reversed depth that the point
///         had then, 0 at infinity; and 1, or 0 where it lay behind the eye and has no place on the page.
///         What was seen at that place then is the same point unless its depth differs: it was hidden
/// Cost    one full-screen dispatch, three vertices gathered twice a pixel; 16 bytes written a pixel
[[nodiscard]] gpu::ImageId add_motion(gpu::Graph& graph, const MotionInputs& in);

} // namespace estampe::motion
