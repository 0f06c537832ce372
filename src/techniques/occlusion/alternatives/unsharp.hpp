// SPDX-License-Identifier: MIT
#pragma once

// Occlusion as a mask of depth.

#include "techniques/occlusion/occlusion.hpp"

namespace estampe::occlusion {

/// Darkens what lies behind the mean of the depths about it, as a drawing does that lifts things off their
/// ground: no light is computed.
///
/// Cost    three dispatches, two over every second pixel each way: 16 depths each, then 4 at every pixel
/// Source  Luft, Colditz and Deussen, "Image Enhancement by Unsharp Masking the Depth Buffer", SIGGRAPH 2006
[[nodiscard]] AmbientOcclusion add_unsharp(gpu::Graph& graph, const OcclusionInputs& in,
                                           const OcclusionStyle& style);

} // namespace estampe::occlusion
