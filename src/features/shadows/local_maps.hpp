// SPDX-License-Identifier: MIT
#pragma once

// The shadow maps of local lights on the device: which passes bring them up to date.

#include "features/shadows/local_shadows.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/raster/views/views.hpp"

namespace estampe::features {

/// The views to draw, for the device.
struct LocalViewBuffers {
    gpu::Buffer whole;
    gpu::Buffer still;
    gpu::Buffer moving;
};

/// Shadow maps of local lights.
struct LocalShadowBuffers {
    gpu::Buffer shadows; ///< LocalShadow, one for each light that has maps
    gpu::Buffer maps;    ///< their texels, kept from frame to frame
    gpu::Buffer layers;  ///< the same of what stands still, where some light has such a layer
    LocalViewBuffers views;
};

/// Which casters count.
enum class Casters : uint8_t { all, still, moving };

/// What blocks a light that `groups` of casters shadow, as runs of triangles, in place of what `batches`
/// held.
void list_casters(const pose::MeshData& layout, Groups groups, Casters which,
                  std::vector<raster::Batch>& batches);

/// The same in a list of its own.
[[nodiscard]] std::vector<raster::Batch> caster_batches(const pose::MeshData& layout, Groups groups,
                                                        Casters which = Casters::all);

[[nodiscard]] CasterKinds caster_kinds(const pose::MeshData& layout);

struct LocalMapInputs {
    const raster::RasterInputs& raster;
    const pose::MeshData& layout;
    const LocalMapViews& views;
    std::optional<gpu::BufferId> cluster_bounds; ///< needed where there are views
    RasterPath path = RasterPath::compute;       ///< never automatic
    raster::Tuning tuning;
};

/// Draws the maps that are out of date: whole, or what moves alone, over the layer of what stands still.
///
/// Writes  maps and layers of `buffers`; returns the maps
/// Cost    nothing where no map is out of date; else that of raster::add_depth_views() for each list of views
[[nodiscard]] gpu::BufferId add_local_maps(gpu::Graph& graph, const LocalMapInputs& in,
                                           LocalShadowBuffers& buffers);

} // namespace estampe::features
