// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_VARIANTS_GLSL_H
#define ESTAMPE_VARIANTS_GLSL_H
// What is asked of the shaders of chains, shader by shader.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

// Outlines run along the edges of the mesh, not through its triangles.
SHARED_CONSTANT uint mark_along_edges = 1U << 0U;

SHARED_CONSTANT uint emit_has_loose_edges = 1U << 0U;
SHARED_CONSTANT uint emit_along_edges = 1U << 1U; // outlines run along those alone

// Some points lie between vertices, and some pieces within triangles.
SHARED_CONSTANT uint order_features_leave_edges = 1U << 0U;

SHARED_CONSTANT uint split_wants_hidden = 1U << 0U; // lines that are not seen

SHARED_CONSTANT uint shape_has_own_outlines = 1U << 0U; // that some material brings
SHARED_CONSTANT uint shape_recalls_frame = 1U << 1U;    // there was one before this
SHARED_CONSTANT uint shape_is_remembered = 1U << 2U;    // there will be one after it
SHARED_CONSTANT uint shape_has_brushes = 1U << 3U;
SHARED_CONSTANT uint shape_has_sway = 1U << 4U;
SHARED_CONSTANT uint shape_has_jitter = 1U << 5U;   // the hand strays, or draws a line again
SHARED_CONSTANT uint shape_has_widths_m = 1U << 6U; // some widths are those of the scene
SHARED_CONSTANT uint shape_swells_in_turns = 1U << 7U;
SHARED_CONSTANT uint shape_is_even_in_shade = 1U << 8U; // strokes do not swell where it is dark
SHARED_CONSTANT uint shape_is_hidden = 1U << 9U;        // these are hidden lines
SHARED_CONSTANT uint shape_stretches = 1U << 10U;       // brushes go from end to end of a stroke
SHARED_CONSTANT uint shape_has_looks = 1U << 11U;       // surfaces differ

SHARED_CONSTANT uint joints_has_brushes = 1U << 0U; // whose corners stay as they are

SHARED_CONSTANT uint ink_layer_has_own_outlines = 1U << 0U; // that some material brings
SHARED_CONSTANT uint ink_layer_has_looks = 1U << 1U;        // surfaces differ

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
