// SPDX-License-Identifier: MIT
#pragma once

// Draws many depth maps together, as local lights need them. All views are drawn in one set of dispatches or
// one draw call, with only the triangles that a view may show.

#include <optional>
#include <vector>

#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

/// Tiles of depth views that must be drawn, in the format of shaders/tiles.glsl.h. View sizes must be
/// multiples of the tile size.
struct ViewTiles {
    gpu::BufferId list;
    uint32_t count = 0; ///< number of tiles in the list, 1 to 65535
};

/// The depth views to draw, on CPU and GPU. Sizes are multiples of 2 and at most 16384 texels, first texels
/// multiples of 4; maps do not overlap. There are at most 32768 views. Only the compute path supports
/// RasterView::turn_px.
struct DepthViews {
    const std::vector<shared::RasterView>& list; ///< all views; place_views() must have placed them
    gpu::BufferId records;                       ///< copy of `list` in a device buffer
    gpu::BufferId bounds;                  ///< boxes of the triangles' clusters, from add_cluster_bounds()
    RasterPath path = RasterPath::compute; ///< raster path for the views; never automatic
    Tuning tuning;
    /// Tiles of the views that will be read later. Outside the listed tiles, the compute path does not clear
    /// the old content before it draws.
    std::optional<ViewTiles> tiles = std::nullopt;
};

/// Gives each view its own square in the image of the hardware path (`origin_px`). Must be called before the
/// views are uploaded. Cost: a sort.
void place_views(std::vector<shared::RasterView>& views);

/// Draws the depth of each view into its texels of `target`, like add_depth(). Texels outside all views stay
/// unchanged. Draws both sides of triangles.
///
/// Cost    compute: a clear of the views or of their tiles, and three dispatches and a small clear per batch,
///         with each vertex loaded once for all views; hardware: a cull and a draw call per batch, and a
///         copy of the views
/// Source  culling by clusters after Haar and Aaltonen, "GPU-Driven Rendering Pipelines", 2015
[[nodiscard]] gpu::BufferId add_depth_views(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                            std::span<const Batch> batches, const DepthViews& views,
                                            gpu::BufferId target);

/// Merges the views of `source` into the texels of `target` at equal positions. Each texel keeps the nearer
/// depth, bit-identical to drawing everything into one map. Both buffers hold the bits of depths of at most
/// 1.
///
/// Cost    one dispatch; three accesses per texel
[[nodiscard]] gpu::BufferId add_merged_views(gpu::Graph& graph, const gpu::Name& name,
                                             const DepthViews& views, gpu::BufferId source,
                                             gpu::BufferId target);

} // namespace estampe::raster
