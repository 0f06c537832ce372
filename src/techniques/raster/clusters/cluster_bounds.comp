// SPDX-License-Identifier: MIT
// Computes clusters' bounding boxes: one workgroup per cluster with a thread per triangle, or one thread per
// cluster.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
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

layout(constant_id = 0) const uint variant = 0u;

shared vec3 low[cluster_triangles];
shared vec3 high[cluster_triangles];

void add_triangle(uint triangle, inout vec3 least, inout vec3 most)
{
    uvec4 corners = triangle_at(triangle);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    least = min(least, min(min(a, b), c));
    most = max(most, max(max(a, b), c));
}

void bound_by_thread()
{
    uint cluster = item_index();
    uint first = cluster * cluster_triangles;
    if (first >= triangle_count) {
        return;
    }
    vec3 least = vec3(1e30);
    vec3 most = vec3(-1e30);
    // The last cluster may have fewer triangles; the cluster's last triangle is then added repeatedly.
    for (uint i = 0u; i < cluster_triangles; ++i) {
        add_triangle(min(first + i, triangle_count - 1u), least, most);
    }
    bounds[cluster] = ClusterBounds(least, most);
}

void bound_by_workgroup()
{
    uint cluster = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    uint triangle = cluster * cluster_triangles + lane;
    vec3 least = vec3(1e30);
    vec3 most = vec3(-1e30);
    if (triangle < triangle_count) {
        add_triangle(triangle, least, most);
    }
    low[lane] = least;
    high[lane] = most;
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

void main()
{
    if ((variant & bounds_by_thread) != 0u) {
        bound_by_thread();
    } else {
        bound_by_workgroup();
    }
}
