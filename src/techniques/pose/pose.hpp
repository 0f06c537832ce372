// SPDX-License-Identifier: MIT
#pragma once

// Puts the meshes on the GPU and poses there, in one dispatch, those vertices that have to be posed anew.

#include <span>

#include "core/inline_vector.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/pose/pose_variant.glsl.h"

namespace estampe::pose {

/// Consecutive posed vertices.
struct VertexRun {
    uint32_t first = 0;
    uint32_t count = 0;
    bool operator==(const VertexRun&) const = default;
};

using VertexRuns = InlineVector<VertexRun, shared::most_pose_runs>;

/// The vertices that stand otherwise in `now` than in `before`, all of them where that is null, and those of
/// the draws `written_over`, which are in ascending order. What lies between the nearest of many runs is in
/// them as well. Cost: linear in draws, joints and weights.
[[nodiscard]] VertexRuns runs_to_pose(const MeshData& meshes, const PoseData* before, const PoseData& now,
                                      std::span<const uint32_t> written_over);

/// What stands in a buffer of posed vertices.
struct PosedAs {
    PoseData pose;
    bool is_known = false;
};

/// A scene's meshes on the GPU. The posed vertices are kept twice: of this frame and of the one before.
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

/// Uploads `data`. Throws Error when it does not fit the device. Cost: one copy of everything.
[[nodiscard]] MeshBuffers upload_meshes(gpu::Device& device, const MeshData& data);

/// Overwrites what moves: draws, joints, weights, and the triangles when draws of `data`, which `meshes` were
/// made of, turned inside out or back; returns whether any did. Waits for the copy.
bool upload_pose(gpu::Device& device, MeshBuffers& meshes, MeshData& data, const PoseData& pose);

/// What was of this frame is of the one before, and the other way round.
void swap_posed(MeshBuffers& meshes);

/// Poses vertices of `meshes`, which were made of `data`: morph targets, then the skin, or the place of the
/// object where there is none. Only those are posed that do not stand in their buffer as `now`, which was
/// uploaded, has them, and those of the draws `written_over`, in ascending order, in whose place others
/// write. `draws` and `rest_vertices` are their handles in this graph. Call keep_posed() when the graph has
/// run.
///
/// Writes  posed vertices, relative to the anchor
/// Cost    a dispatch for each of the runs that runs_to_pose() finds, one thread per vertex
/// Source  linear blend skinning as glTF 2.0, section 3.7.3, has it
[[nodiscard]] gpu::BufferId add_pose_of_moved(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data,
                                              const PoseData& now, std::span<const uint32_t> written_over,
                                              gpu::BufferId draws, gpu::BufferId rest_vertices);

/// What add_pose_of_moved() was to pose is posed.
void keep_posed(MeshBuffers& meshes);

} // namespace estampe::pose
