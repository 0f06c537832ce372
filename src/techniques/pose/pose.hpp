// SPDX-License-Identifier: MIT
#pragma once

// Uploads meshes to the GPU, and poses the changed vertices there in one dispatch.

#include <span>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/pose/pose_variant.glsl.h"

namespace estampe::pose {

/// A run of consecutive posed vertices.
struct VertexRun {
    uint32_t first = 0;
    uint32_t count = 0;
    bool operator==(const VertexRun&) const = default;
};

using VertexRuns = InlineVector<VertexRun, shared::most_pose_runs>;

/// The vertices whose pose differs between `before` and `now` (all vertices if `before` is null), and the
/// vertices of the draw calls `written_over`. The numbers in `written_over` must be in ascending order. If
/// there are too many runs (ranges of consecutive vertices), some runs are merged, together with the vertices
/// between them. Cost: linear in draw calls, joints and weights.
[[nodiscard]] VertexRuns runs_to_pose(const MeshData& meshes, const PoseData* before, const PoseData& now,
                                      std::span<const uint32_t> written_over);

/// Records the pose to which a buffer of vertices was posed.
struct PosedAs {
    PoseData pose;
    bool is_known = false;
};

/// A scene's meshes on the GPU. Posed vertices are stored for this frame and for the last frame.
struct MeshBuffers {
    gpu::Buffer rest_vertices;
    gpu::Buffer skin_vertices;
    gpu::Buffer morph_offsets;
    gpu::Buffer triangles;
    gpu::Buffer stroke_coordinates;
    gpu::Buffer draw_of_vertex;
    gpu::Buffer draws;
    gpu::Buffer joints;
    gpu::Buffer morph_weights;
    gpu::Buffer posed_vertices[2];
    PosedAs posed_as[2];
    uint32_t vertex_count = 0;
};

/// Uploads the meshes of `data`. Throws Error when the meshes do not fit the device. Cost: one copy of
/// everything.
[[nodiscard]] MeshBuffers upload_meshes(gpu::Device& device, const MeshData& data);

/// Uploads the pose: draw records, joints, weights, and the triangles if mirrored flags change. `meshes` must
/// be made from `data`. Returns whether triangles changed. Waits for the copy.
bool upload_pose(gpu::Device& device, MeshBuffers& meshes, MeshData& data, const PoseData& pose);

/// Swaps the buffers of posed vertices of this frame and the last frame.
void swap_posed(MeshBuffers& meshes);

/// Adds a pass that poses vertices of `meshes`, which must be made from `data`. The pass applies morph
/// targets, then the skin, or the object's transform if there is no skin. The pass poses only vertices whose
/// buffer differs from the pose `now`, and the vertices of the draw calls `written_over`. The pose `now` must
/// be uploaded. `written_over` lists, in ascending order, the draw calls whose vertices other passes
/// overwrite. `draws` and `rest_vertices` are the handles, in `graph`, of the draw records and rest vertices
/// of `meshes`. Call keep_posed() after the graph has run.
///
/// Writes  posed vertices, relative to the anchor (a nearby origin)
/// Cost    one dispatch over the runs of runs_to_pose(), one thread per vertex
/// Source  linear blend skinning as in glTF 2.0, section 3.7.3
[[nodiscard]] gpu::BufferId add_pose_of_moved(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data,
                                              const PoseData& now, std::span<const uint32_t> written_over,
                                              gpu::BufferId draws, gpu::BufferId rest_vertices);

/// Confirms that the graph of add_pose_of_moved() has run, so that the posed vertices are valid.
void keep_posed(MeshBuffers& meshes);

} // namespace estampe::pose
