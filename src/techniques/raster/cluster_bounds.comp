// SPDX-License-Identifier: MIT
// One workgroup finds the box about one cluster, a thread to a triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/raster.glsl.h"

layout(local_size_x = cluster_triangles) in;

#define MESH_TEXELS_BINDING 0
#include "shaders/mesh_texels.glsl"

layout(scalar, binding = 2) writeonly buffer Bounds
{
    ClusterBounds bounds[];
};

layout(push_constant) uniform Constants
{
    uint triangle_count;
};

shared vec3 low[cluster_triangles];
shared vec3 high[cluster_triangles];

void main()
{
    uint cluster = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    uint triangle = cluster * cluster_triangles + lane;
    low[lane] = vec3(1e30);
    high[lane] = vec3(-1e30);
    if (triangle < triangle_count) {
        uvec4 corners = triangle_at(triangle);
        vec3 a = posed_vertex_at(corners.x).position;
        vec3 b = posed_vertex_at(corners.y).position;
        vec3 c = posed_vertex_at(corners.z).position;
        low[lane] = min(min(a, b), c);
        high[lane] = max(max(a, b), c);
    }
    for (uint half_count = cluster_triangles / 2u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (lane < half_count) {
            low[lane] = min(low[lane], low[lane + half_count]);
            high[lane] = max(high[lane], high[lane + half_count]);
        }
    }
    if (lane == 0u && cluster * cluster_triangles < triangle_count) {
        bounds[cluster] = ClusterBounds(low[0], high[0]);
    }
}
