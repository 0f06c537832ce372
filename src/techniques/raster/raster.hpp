// SPDX-License-Identifier: MIT
#pragma once

// Rasterisation: writes which triangle is seen at each pixel, or only how far it is. Either in compute or by
// the device's own rasteriser; what comes out has the same form, and is the same in 99.99 % of pixels.

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

/// How triangles are drawn; never automatic.
struct Paths {
    RasterPath page = RasterPath::compute; ///< of what is seen by the eye
    RasterPath maps = RasterPath::compute; ///< of what lights see, and of far sides, at every second pixel

    friend bool operator==(const Paths&, const Paths&) = default;
};

/// The meshes to draw, and what alpha masks look up.
struct RasterInputs {
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    gpu::BufferId draws;
    gpu::BufferId rest_vertices;
    gpu::BufferId materials;
    std::array<gpu::ImageId, 5> textures;
    uint32_t texture_classes = 0; ///< a bit for each of them that holds anything
};

/// Inputs for batches that are not masked: something stands in for what masks look up.
[[nodiscard]] RasterInputs unmasked_inputs(gpu::Graph& graph, gpu::BufferId triangles,
                                           gpu::BufferId posed_vertices);

/// Triangles to draw: consecutive in the triangle list.
struct Batch {
    uint32_t first_triangle = 0;
    uint32_t triangle_count = 0;
    bool masked = false;   ///< alpha masks are tested
    bool plain = false;    ///< no triangle is two-sided or mirrored; the hardware path is quicker for knowing
    uint32_t groups = ~0U; ///< where many views are drawn: drawn into those that share a bit
};

/// How the work is shared out; the picture does not depend on it.
struct Tuning {
    uint32_t small_area_px = 128; ///< largest bounding box of a triangle that one thread draws alone
    uint32_t list_groups = 4096;  ///< workgroups that take turns at a list whose length only the device knows
    bool threads_list_tiles =
        true; ///< each of the triangle it has, rather than a workgroup of one after another
    /// Triangles of a batch from which on the hardware draws a list of those that may cover a pixel.
    uint32_t culled_from = 8192;
    /// Triangles of a batch from which on compute draws a list of the clusters that the page may show, where
    /// their boxes are known. What that saves a GPU of less is what the list costs.
    uint32_t clusters_from = 2'000'000;
    /// One thread finds the box about a whole cluster; otherwise a workgroup does, a thread per triangle.
    /// Processors run the barriers of a workgroup slowly.
    bool threads_bound_clusters = false;
};

/// How a device draws soonest.
[[nodiscard]] Tuning tuning_of(const gpu::ExecutionProfile& execution);

struct View {
    glm::mat4 clip_from_anchor{1.0F}; ///< reversed z, y down
    glm::uvec2 size_px{0};
    bool cull_back_faces = true;           ///< of triangles that are not two-sided
    RasterPath path = RasterPath::compute; ///< never automatic
    Tuning tuning;
    /// A visibility buffer of the same size: only what lies behind is drawn, and of equal depths what has a
    /// lower number, so that one layer after another is peeled off. For identities.
    std::optional<gpu::BufferId> behind = std::nullopt;
    /// With that, only every second pixel each way is drawn, from this one on, 0 or 1: the picture is half as
    /// large as the one that is peeled.
    std::optional<glm::uvec2> second_from = std::nullopt;

    std::optional<gpu::BufferId> cluster_bounds =
        std::nullopt; ///< of all triangles, see add_cluster_bounds()

    /// Of the picture that is drawn.
    [[nodiscard]] glm::uvec2 drawn_px() const
    {
        return second_from ? glm::max((size_px - *second_from + 1U) / 2U, glm::uvec2(1)) : size_px;
    }
};

/// A picture of 64-bit words, row by row: reversed depth above, triangle below; 0 where nothing is seen.
///
/// Cost    in compute a clear of the picture, and three dispatches a batch, a small clear between two; in
///         hardware a draw a batch and a copy; time goes with triangles and covered pixels
/// Source  Kenzel et al., "A High-Performance Software Graphics Pipeline Architecture for
/// the GPU", 2018, for the
///         division by size; exact edge functions after Pineda, "A Parallel Algorithm for Polygon
///         Rasterization", 1988
[[nodiscard]] gpu::BufferId add_visibility(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                           std::span<const Batch> batches, const View& view);

/// Visibility of what is nearest, of what lies behind that, and so on: `count` buffers, at least one. Costs
/// as much as so many pictures.
///
/// Source  Everitt, "Interactive Order-Independent Transparency", 2001
[[nodiscard]] std::vector<gpu::BufferId> add_layers(gpu::Graph& graph, const gpu::Name& name,
                                                    const RasterInputs& in, std::span<const Batch> batches,
                                                    View view, uint32_t count);

/// The tiles of 8 x 8 pixels in which a visibility buffer of `size_px` sees anything, see
/// shaders/tiles.glsl.h: a processor pays for pixels that see nothing as for all others. Cost: a small
/// clear and a dispatch of a thread a tile.
[[nodiscard]] gpu::BufferId add_seen_tiles(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId visibility,
                                           glm::uvec2 size_px);

/// Draws a picture of 32-bit words into `target`: the bits of reversed depth as float; 0 where nothing is
/// seen.
[[nodiscard]] gpu::BufferId add_depth(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                      std::span<const Batch> batches, const View& view, gpu::BufferId target);

/// A rectangle of a depth picture, and the texel of a map where its first row begins.
struct DepthPart {
    glm::uvec2 from_px{0};
    glm::uvec2 size_px{0};
    uint32_t first_texel = 0;
};

/// Draws as add_depth() does, and puts `parts` of the picture into `map`, an imported buffer whose rows are
/// `row_texels` apart and whose other texels stay as they are.
[[nodiscard]] gpu::BufferId add_depth_parts(gpu::Graph& graph, const gpu::Name& name, const RasterInputs& in,
                                            std::span<const Batch> batches, const View& view,
                                            const std::vector<DepthPart>& parts, uint32_t row_texels,
                                            gpu::BufferId map);

// Runs of 64 triangles, with a box about each: what a view cannot show is left out by these.

/// Boxes about runs of 64 triangles, one for each run of a list of `triangle_count`.
[[nodiscard]] uint64_t cluster_bounds_bytes(uint64_t triangle_count);

/// Finds the boxes anew, for triangles whose vertices have moved.
///
/// Writes  `bounds`: ClusterBounds, of cluster_bounds_bytes()
/// Cost    one dispatch: a thread per triangle, or per cluster with Tuning::threads_bound_clusters
[[nodiscard]] gpu::BufferId add_cluster_bounds(gpu::Graph& graph, const RasterInputs& in,
                                               uint32_t triangle_count, gpu::BufferId bounds,
                                               const Tuning& tuning = {});

/// The boxes of a scene, kept for as long as it stands as it did.
class ClusterBoxes {
public:
    /// Vertices have moved, or triangles are others.
    void forget() { are_found_ = false; }

    /// Finds them where they are not known. Cost: nothing, or that of add_cluster_bounds().
    [[nodiscard]] gpu::BufferId add(gpu::Graph& graph, gpu::Device& device, const RasterInputs& in,
                                    uint32_t triangle_count, const Tuning& tuning = {});

private:
    gpu::Buffer bounds_;
    bool are_found_ = false;
};

/// The clusters of a batch that the page may show, a workgroup to each: a list as shaders/tiles.glsl.h
/// has it. None where `view` does not ask for it, see Tuning::clusters_from. Not of peels, nor of masked
/// batches.
[[nodiscard]] std::optional<gpu::BufferId> add_seen_clusters(gpu::Graph& graph, const gpu::Name& name,
                                                             const Batch& batch, const View& view,
                                                             const shared::RasterConstants& constants);

/// How many clusters the triangles of a batch lie in.
[[nodiscard]] uint32_t cluster_count(const Batch& batch);

} // namespace estampe::raster
