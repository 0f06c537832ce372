// SPDX-License-Identifier: MIT
// One thread per texel of the map sums the occlusion of the discs, and the light that they bounce onto the
// texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "shaders/unit.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 64) in;

#define MAP_TEXELS_BINDING 0
#include "shaders/surface_map.glsl"

#define MESH_TEXELS_BINDING 1
#include "shaders/mesh_texels.glsl"

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool bounces = (variant & discs_bounce) != 0u;

#define DISCS_BINDING 3
#define DISCS_BOUNCE bounces
#include "techniques/occlusion/alternatives/disc_sum.glsl"

layout(scalar, binding = 5) writeonly buffer Found
{
    // Per texel of the map: bounced light, and visibility in alpha; alpha is -1 where the map has no surface.
    vec4 found[];
};

void main()
{
    uint item = item_index();
    uint count = map_texel_count();
    MapPoint point = map_point_at(min(item, count - 1u));
    uvec4 corners = triangle_at(point.triangle);
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    vec3 place = mat3(a.position, b.position, c.position) * point.weight;
    vec3 normal =
        unit(mat3(unpack_normal(a.normal), unpack_normal(b.normal), unpack_normal(c.normal)) * point.weight +
             1e-12);
    DiscSum sum = sum_of_discs(place, normal, item < count && point.is_there);
    if (item < count) {
        found[item] =
            vec4(bounces ? sum.bounced : vec3(0.0), point.is_there ? max(1.0 - sum.hidden, 0.0) : -1.0);
    }
}
