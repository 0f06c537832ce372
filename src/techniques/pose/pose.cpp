// SPDX-License-Identifier: MIT
#include "techniques/pose/pose.hpp"

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/pose_comp.hpp"
#include "techniques/pose/pose_variant.glsl.h"

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

gpu::BufferId add_pose(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data, gpu::BufferId draws,
                       gpu::BufferId rest_vertices)
{
    auto pass = graph.compute("pose", shaders::pose_comp);
    pass.sample(draws)
        .read(gpu::import_whole(graph, "draw of vertex", meshes.draw_of_vertex))
        .sample(rest_vertices)
        .read(gpu::import_whole(graph, "skin vertices", meshes.skin_vertices))
        .read(gpu::import_whole(graph, "morph offsets", meshes.morph_offsets))
        .read(gpu::import_whole(graph, "joints", meshes.joints))
        .read(gpu::import_whole(graph, "morph weights", meshes.morph_weights));
    const gpu::BufferId posed =
        pass.write(gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]));
    pass.variant((data.joint_count > 0 ? shared::pose_has_skins : 0U) |
                 (data.morph_weight_count > 0 ? shared::pose_has_morphs : 0U));
    pass.push(meshes.vertex_count).dispatch_items(meshes.vertex_count);
    return posed;
}

} // namespace estampe::pose
