// SPDX-License-Identifier: MIT
#pragma once

// Many depth maps at once, as local lights want them: all views in one set of dispatches, or one draw, and
// only the triangles that a view may show.

#include <optional>
#include <vector>

#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// Tiles of views, as shaders/tiles.glsl.h has them, for views whose sides are multiples of its size.
struct ViewTiles {
    gpu::BufferId list;
    uint32_t count = 0; ///< one or more, at most 65535
};

/// The views to draw, on both sides of the bus. Sizes are multiples of 2 and at most 16384 texels, first
/// texels multiples of 4; maps do not overlap. At most 32768 views. Only compute turns views.
struct DepthViews {
    const std::vector<shared::RasterView>& list; ///< placed by place_views()
    gpu::BufferId records;                       ///< the same on the device
    gpu::BufferId bounds;                        ///< of the triangles, from add_cluster_bounds()
    RasterPath path = RasterPath::compute;       ///< never automatic
    Tuning tuning;
    /// Where what is drawn will be looked at: compute clears nothing beside, and draws there over what it
    /// finds.
    std::optional<ViewTiles> tiles = std::nullopt;
};

/// Gives each view a square of its own in the image that the hardware path draws into (`origin_px`). To be
/// called before the views go to the device. Cost: a sort.
void place_views(std::vector<shared::RasterView>& views);

/// Draws the depth of each view into its square of `target`, as add_depth() does; texels of no view stay as
/// they are. Triangles count from either side.
///
/// Cost    in compute a clear of the views or of their tiles, and three dispatches and a small clear a batch,
///         each vertex loaded once for all views; in hardware a cull and a draw a batch, and a copy of the
///         views
/// Source  culling by clusters after Haar and Aaltonen, "GPU-Driven Rendering Pipelines", 2015
[[nodiscard]] gpu::BufferId add_depth_views(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                            std::span<const Batch> batches, const DepthViews& views,
                                            gpu::BufferId target);

/// Merges into the views of `target` what `source` has at the same texels: the nearer of both stays, bit for
/// bit as if all had been drawn into one. Both hold depth bits of at most 1.
///
/// Cost    one dispatch; three accesses a texel
[[nodiscard]] gpu::BufferId add_merged_views(gpu::Graph& graph, const gpu::Name& name,
                                             const DepthViews& views, gpu::BufferId source,
                                             gpu::BufferId target);

} // namespace estampe::raster
