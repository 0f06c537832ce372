// SPDX-License-Identifier: MIT
#include "techniques/pose/pose.hpp"

#include "gpu/upload.hpp"
#include "shaders/pose_comp.hpp"

namespace estampe::pose {

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

void upload_pose(gpu::Device& device, MeshBuffers& meshes, MeshData& data, const PoseData& pose)
{
    if (turn_triangles(data, pose)) {
        meshes.triangles = upload_buffer(device, "triangles", data.triangles);
    }
    meshes.draws = upload_buffer(device, "draws", pose.draws);
    meshes.joints = upload_buffer(device, "joints", pose.joints);
    meshes.morph_weights = upload_buffer(device, "morph weights", pose.morph_weights);
}

gpu::BufferId add_pose(gpu::Graph& graph, const PoseInputs& in, gpu::BufferId posed_vertices,
                       uint32_t vertex_count)
{
    auto pass = graph.compute("pose", shaders::pose_comp);
    pass.read(in.draws)
        .read(in.draw_of_vertex)
        .read(in.rest_vertices)
        .read(in.skin_vertices)
        .read(in.morph_offsets);
    pass.read(in.joints).read(in.morph_weights);
    const gpu::BufferId posed = pass.write(posed_vertices);
    pass.variant((in.has_skins ? 1U : 0U) | (in.has_morphs ? 2U : 0U));
    pass.push(vertex_count).dispatch_items(vertex_count);
    return posed;
}

} // namespace estampe::pose
