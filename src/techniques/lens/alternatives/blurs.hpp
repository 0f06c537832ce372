// SPDX-License-Identifier: MIT
#pragma once

// Methods to blur a packed page that are faster than the mode `gather`, which separates near and far
// surfaces, but less accurate at edges.

#include "gpu/graph/graph.hpp"
#include "techniques/lens/lens.glsl.h"

namespace estampe::lens {

/// Blurs the page horizontally, then vertically. Surfaces that lie behind a pixel do not blur over the pixel.
///
/// Returns rgba32ui: the blurred page
/// Cost    two dispatches, 26 texels per pixel
[[nodiscard]] gpu::ImageId add_separable(gpu::Graph& graph, gpu::ImageId page,
                                         const shared::LensConstants& lens);

/// Blurs the page by reading its mip levels: the mip level with texels as large as the blur circle, or the
/// sum of all mip levels up to that level. The mode that reads one level and the mode that sums levels both
/// blur across edges.
///
/// Reads   `levels`: plain means of the page
/// Returns rgba32ui: the blurred page
/// Cost    one dispatch, at most 20 texels per pixel
/// Source  Demers, "Depth of Field: A Survey of Techniques", GPU Gems, 2004
[[nodiscard]] gpu::ImageId add_looked_up(gpu::Graph& graph, gpu::ImageId page, gpu::ImageId levels,
                                         bool is_sum, const shared::LensConstants& lens);

} // namespace estampe::lens
