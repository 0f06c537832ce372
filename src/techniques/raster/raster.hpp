// SPDX-License-Identifier: MIT
#pragma once

// Rasterisation: writes which triangle is visible at each pixel, or only its depth, by compute shaders or by
// the device's own rasteriser. Both paths have the same output format and agree in 99.99 % of pixels.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "shaders/shared.hpp"
#include "techniques/raster/raster.glsl.h"

namespace estampe::raster {

/// The raster paths (compute or hardware) to draw with; never automatic.
struct Paths {
    RasterPath page = RasterPath::compute; ///< path for the picture that the eye sees
    RasterPath maps = RasterPath::compute; ///< path for shadow maps, and for depth peeling at half resolution

    friend bool operator==(const Paths&, const Paths&) = default;
};

/// The meshes to draw, and the data of alpha masks.
struct RasterInputs {
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    uint32_t texture_classes = 0; ///< one bit for each texture class that is not empty
};

/// Makes inputs for batches without alpha masks; placeholders stand in for the masks' data.
[[nodiscard]] RasterInputs unmasked_inputs(gpu::Graph& graph, gpu::BufferId triangles,
                                           gpu::BufferId posed_vertices);

/// Limit for Batch::alpha_below that no alpha reaches.
inline constexpr float no_alpha_limit = 1e30F;

/// A range of consecutive triangles in the triangle list.
struct Batch {
    uint32_t first_triangle = 0;
    uint32_t triangle_count = 0;
    bool masked = false;
    bool plain = false; ///< no triangles are two-sided or mirrored; speeds up the hardware path
    /// With alpha masks: the texels that are drawn have at least the material's cutoff and this alpha.
    float least_alpha = 0.0F;
    float alpha_below = no_alpha_limit; ///< with alpha masks: only texels of smaller alpha are drawn
    uint32_t groups = ~0U; ///< with many views: bits of object groups; views that share a bit show the batch
};

/// Distribution of raster work on the device. Affects speed only, not the picture.
struct Tuning {
    uint32_t small_area_px = 128; ///< pixels of the bounding box up to which one thread draws a triangle
    /// Number of workgroups that share a list whose length only the device knows.
    uint32_t list_groups = 4096;
    bool threads_list_tiles = true; ///< each thread lists the tiles of its triangle; if false, whole
                                    ///< workgroups do, one triangle after another
    /// The hardware path culls batches with at least this many triangles before it draws them.
    uint32_t culled_from = 8192;
    /// Least number of triangles in a batch that the compute path culls by clusters, if the clusters' boxes
    /// are known. On a GPU, culling smaller batches costs as much as it saves.
    uint32_t clusters_from = 2'000'000;
    /// If true, one thread finds the bounding box of a whole cluster. If false, a workgroup finds the box,
    /// with one thread per triangle. Barriers in workgroups are slow on CPU devices.
    bool threads_bound_clusters = false;
};

/// Returns the tuning of raster work that is fastest on a device.
[[nodiscard]] Tuning tuning_of(const gpu::ExecutionProfile& execution);

struct View {
    glm::mat4 clip_from_anchor{1.0F}; ///< projection of the view; reversed z, y down
    glm::uvec2 size_px{0};
    bool cull_back_faces = true;           ///< culls back faces of triangles that are not two-sided
    RasterPath path = RasterPath::compute; ///< raster path for the view; never automatic
    Tuning tuning;
    /// Depth peeling: the visibility buffer of the previous layer, of equal size. Only surfaces behind that
    /// layer are drawn; at equal depths, only triangles with a lower number.
    std::optional<gpu::BufferId> behind = std::nullopt;
    /// Draws only every second pixel in x and y, from the pixel `second_from` on, which is 0 or 1 in x and in
    /// y. Requires `behind` (the previous layer's picture), which has twice the size of the drawn picture.
    std::optional<glm::uvec2> second_from = std::nullopt;

    std::optional<gpu::BufferId> cluster_bounds =
        std::nullopt; ///< boxes of all clusters, from add_cluster_bounds()
    /// One bit for each cluster of the whole triangle list, in words of 32 bits. Triangles of a cluster whose
    /// bit is 0 are not drawn, except in depth peeling, in masked batches, and in batches of fewer than 8,192
    /// triangles.
    std::optional<gpu::BufferId> seen_clusters = std::nullopt;

    /// Size of the picture that is drawn; half the view's size in depth peeling at half resolution.
    [[nodiscard]] glm::uvec2 drawn_px() const
    {
        return second_from ? glm::max((size_px - *second_from + 1U) / 2U, glm::uvec2(1)) : size_px;
    }
};

/// Draws a visibility buffer of 64-bit words, row by row: reversed depth in the high half, triangle number in
/// the low half; 0 if nothing is visible.
///
/// Cost    compute: a clear of the picture, and three dispatches and a small clear per batch; hardware: a
///         draw call per batch and a copy; time grows with triangles and covered pixels
/// Source  division by size: Kenzel et al., "A High-Performance Software Graphics Pipeline Architecture for
///         the GPU", 2018; exact edge functions after Pineda, "A Parallel Algorithm for Polygon
///         Rasterization", 1988
[[nodiscard]] gpu::BufferId add_visibility(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                           std::span<const Batch> batches, const View& view);

/// Depth peeling: draws visibility buffers of the nearest surface, the surface behind it, and so on. Returns
/// `count` buffers, at least one. Costs as much as `count` pictures.
///
/// Source  Everitt, "Interactive Order-Independent Transparency", 2001
[[nodiscard]] std::vector<gpu::BufferId> add_layers(gpu::Graph& graph, const gpu::Name& name,
                                                    const RasterInputs& in, std::span<const Batch> batches,
                                                    View view, uint32_t count);

/// Lists the tiles of 8 x 8 pixels in which a visibility buffer of `size_px` shows a surface, see
/// shaders/tiles.glsl.h. Passes that use the list skip empty tiles, which cost as much as covered ones on CPU
/// devices. Cost: a small clear and a dispatch with one thread per tile.
[[nodiscard]] gpu::BufferId add_seen_tiles(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId visibility,
                                           glm::uvec2 size_px);

/// Draws depth into `target`, as 32-bit words: the bits of reversed float depth; 0 if nothing is visible.
[[nodiscard]] gpu::BufferId add_depth(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                      std::span<const Batch> batches, const View& view, gpu::BufferId target);

/// A rectangle of a depth picture, and the texel of a map at which the rectangle's first row begins.
struct DepthPart {
    glm::uvec2 from_px{0};
    glm::uvec2 size_px{0};
    uint32_t first_texel = 0;
};

/// Draws like add_depth(), and copies `parts` of the picture into `map`, an imported buffer with rows of
/// `row_texels`. Other texels of `map` stay unchanged.
[[nodiscard]] gpu::BufferId add_depth_parts(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                            std::span<const Batch> batches, const View& view,
                                            const std::vector<DepthPart>& parts, uint32_t row_texels,
                                            gpu::BufferId map);

// Clusters of 64 consecutive triangles with bounding boxes. A view skips the clusters that it cannot show.

/// Size in bytes of the bounding boxes of all clusters in a list of `triangle_count` triangles.
[[nodiscard]] uint64_t cluster_bounds_bytes(uint64_t triangle_count);

/// Adds a pass that computes the clusters' bounding boxes. The boxes must be computed again after vertices
/// have moved.
///
/// Writes `bounds`: ClusterBounds, of cluster_bounds_bytes() Cost one dispatch: a thread per triangle, or per
/// cluster with Tuning::threads_bound_clusters
[[nodiscard]] gpu::BufferId add_cluster_bounds(gpu::Graph& graph, const RasterInputs& in,
                                               uint32_t triangle_count, gpu::BufferId bounds,
                                               const Tuning& tuning = {});

/// Keeps the bounding boxes of a scene's clusters as long as the scene is static.
class ClusterBoxes {
public:
    /// Discards the boxes. To be called after vertices have moved or triangles have changed.
    void forget() { are_found_ = false; }

    /// Computes the clusters' boxes if they are not known, which costs as much as add_cluster_bounds(). Costs
    /// nothing if they are known.
    [[nodiscard]] gpu::BufferId add(gpu::Graph& graph, gpu::Device& device, const RasterInputs& in,
                                    uint32_t triangle_count, const Tuning& tuning = {});

private:
    gpu::Buffer bounds_;
    bool are_found_ = false;
};

/// Adds a pass that lists the clusters of a batch that the page may show, one workgroup per cluster, in the
/// format of shaders/tiles.glsl.h. Empty if `view` does not need the list (see Tuning::clusters_from and
/// View::seen_clusters), for depth peeling, and for masked batches.
[[nodiscard]] std::optional<gpu::BufferId> add_seen_clusters(gpu::Graph& graph, const gpu::Name& name,
                                                             const Batch& batch, const View& view,
                                                             const shared::RasterConstants& constants);

/// Number of clusters that contain the triangles of a batch.
[[nodiscard]] uint32_t cluster_count(const Batch& batch);

} // namespace estampe::raster
