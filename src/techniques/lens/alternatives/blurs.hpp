// SPDX-License-Identifier: MIT
#pragma once

// Blurs of a packed page that are quicker than the near and far field of `gather`, and less right at edges.

#include "gpu/graph/graph.hpp"
#include "techniques/lens/lens.glsl.h"

namespace estampe::lens {

/// Blurs across the page and then down it. What lies farther off than a pixel does not run over it.
///
/// Returns rgba32ui: the page, blurred
/// Cost    two dispatches, 26 texels a pixel
[[nodiscard]] gpu::ImageId add_separable(gpu::Graph& graph, gpu::ImageId page,
                                         const shared::LensConstants& lens);

/// Looks up smaller pages: that whose pixels are as large as the circle, or the sum of all up to it. Both run
/// over edges.
///
/// Reads   `levels`: plain means of the page
/// Returns as add_separable()
/// Cost    one dispatch, 20 texels a pixel at most
/// Source  Demers, "Depth of Field: A Survey of Techniques", GPU Gems, 2004
[[nodiscard]] gpu::ImageId add_looked_up(gpu::Graph& graph, gpu::ImageId page, gpu::ImageId levels,
                                         bool is_sum, const shared::LensConstants& lens);

} // namespace estampe::lens
