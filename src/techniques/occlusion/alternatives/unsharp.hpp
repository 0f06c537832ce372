// SPDX-License-Identifier: MIT
#pragma once

// Depth darkening: unsharp masking of the depth buffer.

#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {

/// Adds passes that darken points farther from the eye than the mean depth around them, as illustrators
/// darken the background beside an object. No light is computed.
///
/// Cost    three dispatches: two over every second pixel in x and y, with 16 depths per pixel; one over every
///         pixel, with 4 samples per pixel
/// Source  Luft, Colditz and Deussen, "Image Enhancement by Unsharp Masking the Depth Buffer", SIGGRAPH 2006
[[nodiscard]] AmbientOcclusion add_unsharp(gpu::Graph& graph, const OcclusionInputs& in,
                                           const OcclusionStyle& style);

} // namespace estampe::occlusion
