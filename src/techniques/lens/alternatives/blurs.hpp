// SPDX-License-Identifier: MIT
#pragma once

// Blurs of a packed page that are faster than near and far fields (mode `gather`), but less accurate at
// edges.

#include "gpu/graph/graph.hpp"
#include "techniques/lens/lens.glsl.h"

namespace estampe::lens {

/// Blurs the page horizontally, then vertically. Surfaces that lie behind a pixel do not blur over it.
///
/// Returns rgba32ui: the blurred page
/// Cost    two dispatches, 26 texels per pixel
[[nodiscard]] gpu::ImageId add_separable(gpu::Graph& graph, gpu::ImageId page,
                                         const shared::LensConstants& lens);

/// Reads mip levels of the page: the level whose texels are as large as the blur circle, or the sum of all
/// levels up to it. Both modes blur across edges.
///
/// Reads   `levels`: plain means of the page
/// Returns as add_separable()
/// Cost    one dispatch, at most 20 texels per pixel
/// Source  Demers, "Depth of Field: A Survey of Techniques", GPU Gems, 2004
[[nodiscard]] gpu::ImageId add_looked_up(gpu::Graph& graph, gpu::ImageId page, gpu::ImageId levels,
                                         bool is_sum, const shared::LensConstants& lens);

} // namespace estampe::lens
