// SPDX-License-Identifier: MIT
#include "techniques/pose/pose.hpp"

#include <utility>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/pose_comp.hpp"
#include "techniques/pose/pose_variant.glsl.h"

namespace estampe::pose {
namespace {

gpu::BufferId add_runs(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data, const VertexRuns& runs,
                       gpu::BufferId draws, gpu::BufferId rest_vertices)
{
    gpu::BufferId posed = gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]);
    const auto draw_of_vertex = gpu::import_whole(graph, "draw of vertex", meshes.draw_of_vertex);
    const auto skin_vertices = gpu::import_whole(graph, "skin vertices", meshes.skin_vertices);
    const auto morph_offsets = gpu::import_whole(graph, "morph offsets", meshes.morph_offsets);
    const auto joints = gpu::import_whole(graph, "joints", meshes.joints);
    const auto morph_weights = gpu::import_whole(graph, "morph weights", meshes.morph_weights);
    shared::PoseRuns constants{};
    for (const VertexRun& run : runs) {
        constants.item_count += run.count;
        constants.firsts[constants.run_count] = run.first;
        constants.ends[constants.run_count++] = constants.item_count;
    }
    if (constants.item_count == 0) {
        return posed;
    }
    auto pass = graph.compute("pose", shaders::pose_comp);
    pass.sample(draws).read(draw_of_vertex).sample(rest_vertices);
    pass.read(skin_vertices).read(morph_offsets).read(joints).read(morph_weights);
    posed = pass.modify(posed);
    pass.variant((data.joint_count > 0 ? shared::pose_has_skins : 0U) |
                 (data.morph_weight_count > 0 ? shared::pose_has_morphs : 0U));
    pass.push(constants).dispatch_items(constants.item_count);
    return posed;
}

} // namespace

MeshBuffers upload_meshes(gpu::Device& device, const MeshData& data)
{
    MeshBuffers meshes;
    meshes.rest_vertices = upload_buffer(device, "rest vertices", data.rest_vertices);
    meshes.skin_vertices = upload_buffer(device, "skin vertices", data.skin_vertices);
    meshes.morph_offsets = upload_buffer(device, "morph offsets", data.morph_offsets);
    meshes.triangles = upload_buffer(device, "triangles", data.triangles);
    meshes.stroke_coordinates = upload_buffer(device, "stroke coordinates", data.stroke_coordinates);
    meshes.draw_of_vertex = upload_buffer(device, "draw of vertex", data.draw_of_vertex);
    meshes.vertex_count = static_cast<uint32_t>(data.draw_of_vertex.size());
    for (gpu::Buffer& posed : meshes.posed_vertices) {
        posed = gpu::Buffer(device, "posed vertices", meshes.vertex_count * sizeof(shared::PosedVertex),
                            gpu::MemoryUse::device);
    }
    return meshes;
}

bool upload_pose(gpu::Device& device, MeshBuffers& meshes, MeshData& data, const PoseData& pose)
{
    const bool has_turned = turn_triangles(data, pose);
    if (has_turned) {
        meshes.triangles = upload_buffer(device, "triangles", data.triangles);
    }
    meshes.draws = upload_buffer(device, "draws", pose.draws);
    meshes.joints = upload_buffer(device, "joints", pose.joints);
    meshes.morph_weights = upload_buffer(device, "morph weights", pose.morph_weights);
    return has_turned;
}

void swap_posed(MeshBuffers& meshes)
{
    std::swap(meshes.posed_vertices[0], meshes.posed_vertices[1]);
    std::swap(meshes.posed_as[0], meshes.posed_as[1]);
}

gpu::BufferId add_pose(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data, gpu::BufferId draws,
                       gpu::BufferId rest_vertices)
{
    return add_runs(graph, meshes, data, {VertexRun{.count = meshes.vertex_count}}, draws, rest_vertices);
}

gpu::BufferId add_pose_of_moved(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data,
                                const PoseData& now, std::span<const uint32_t> written_over,
                                gpu::BufferId draws, gpu::BufferId rest_vertices)
{
    PosedAs& posed = meshes.posed_as[0];
    const VertexRuns runs = runs_to_pose(data, posed.is_known ? &posed.pose : nullptr, now, written_over);
    posed.is_known = false; // until the graph has run
    posed.pose = now;
    return add_runs(graph, meshes, data, runs, draws, rest_vertices);
}

void keep_posed(MeshBuffers& meshes)
{
    meshes.posed_as[0].is_known = true;
}

} // namespace estampe::pose
