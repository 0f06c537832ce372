// SPDX-License-Identifier: MIT
// One thread poses one vertex: morph targets first, then the skin or the object's transform.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/scene.glsl.h"
#include "shaders/unit.glsl"
#include "techniques/pose/pose_variant.glsl.h"

layout(local_size_x = 64) in;

#define DRAW_TEXELS_BINDING 0
#include "shaders/draw_texels.glsl"

layout(scalar, binding = 1) readonly buffer DrawOfVertex
{
    uint draw_of_vertex[];
};

#define REST_TEXELS_BINDING 2
#include "shaders/rest_texels.glsl"

layout(scalar, binding = 3) readonly buffer SkinVertices
{
    SkinVertex skin_vertices[];
};

layout(scalar, binding = 4) readonly buffer MorphOffsets
{
    MorphOffset morph_offsets[];
};

layout(scalar, binding = 5) readonly buffer Joints
{
    mat4 anchor_from_bind[];
};

layout(scalar, binding = 6) readonly buffer MorphWeights
{
    float morph_weights[];
};

layout(scalar, binding = 7) writeonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(push_constant, scalar) uniform Constants
{
    PoseRuns runs;
};

layout(constant_id = 0) const uint variant = 3u;
const bool has_skins = (variant & pose_has_skins) != 0u;
const bool has_morphs = (variant & pose_has_morphs) != 0u;

mat4 skin_matrix(DrawPose draw, uint local)
{
    SkinVertex skin = skin_vertices[draw.first_skin_vertex + local];
    mat4 blended = mat4(0.0);
    for (uint pair = 0u; pair < 4u; ++pair) {
        uint joints = skin.joints[pair];
        vec2 weights = unpackUnorm2x16(skin.weights[pair]);
        if (weights.x > 0.0) {
            blended += weights.x * anchor_from_bind[draw.first_joint + (joints & 0xffffu)];
        }
        if (weights.y > 0.0) {
            blended += weights.y * anchor_from_bind[draw.first_joint + (joints >> 16)];
        }
    }
    return blended;
}

void main()
{
    uint item = item_index();
    if (item >= runs.item_count) {
        return;
    }
    uint index = runs.firsts[0] + item;
    for (uint i = 1u; i < runs.run_count; ++i) {
        index = item >= runs.ends[i - 1u] ? runs.firsts[i] + item - runs.ends[i - 1u] : index;
    }
    uint draw_index = draw_of_vertex[index];
    DrawPose draw = draw_pose_at(draw_index);
    DrawPart lists = draw_at(draw_index);
    uint local = index - lists.first_posed_vertex;
    RestVertex rest = rest_vertex_at(lists.first_rest_vertex + local);
    vec3 position = rest.position;
    vec3 normal = unpack_normal(rest.normal);
    if (has_morphs) {
        for (uint target = 0u; target < draw.morph_target_count; ++target) {
            float weight = morph_weights[draw.first_morph_weight + target];
            if (weight != 0.0) {
                MorphOffset offset =
                    morph_offsets[draw.first_morph_offset + target * draw.vertex_count + local];
                position += weight * offset.position;
                normal += weight * offset.normal;
            }
        }
    }
    mat4 place = draw.anchor_from_object;
    if (has_skins && draw.first_skin_vertex != no_skin) {
        place = skin_matrix(draw, local);
    }
    vec4 posed = place * vec4(position, 1.0);
    mat3 linear = mat3(place);
    // The cofactor matrix transforms normals like the inverse transpose, and also works for a scale of 0.
    mat3 cofactor =
        mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
    // A mirrored transform has a negative determinant and would turn normals inwards.
    vec3 turned = cofactor * normal * (dot(linear[0], cofactor[0]) < 0.0 ? -1.0 : 1.0);
    float turned_length = length(turned);
    turned = turned_length > 0.0 ? turned / turned_length : vec3(0.0, 1.0, 0.0);
    posed_vertices[index].position = posed.xyz;
    posed_vertices[index].normal = pack_normal(turned);
}
