// SPDX-License-Identifier: MIT
// One workgroup handles one cluster, one thread handles one triangle. The thread loads the triangle's corners
// once, and draws the triangle into each view that may show the cluster.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

#include "techniques/raster/compute/raster.glsl"
#include "techniques/raster/clusters/view_cull.glsl"

layout(local_size_x = cluster_triangles) in;

layout(scalar, binding = 7) readonly buffer Bounds
{
    ClusterBounds bounds[];
};

// One bit for each of 64 views; set if the view may show this cluster.
shared uint showing[cluster_triangles / 32u];

void draw_into(uint view_index, uint triangle, uint flags, vec3 a, vec3 b, vec3 c)
{
    select_view(view_index);
    ClippedTriangle clipped = clip_corners(a, b, c);
    draw_part(clipped, 0u, view_index, triangle, flags);
    if (clipped.count == 4) {
        draw_part(clipped, 1u, view_index, triangle, flags);
    }
}

void main()
{
    uint lane = gl_LocalInvocationID.x;
    uint last_triangle = constants.first_triangle + constants.triangle_count - 1u;
    uint cluster = constants.first_triangle / cluster_triangles + gl_WorkGroupID.y * gl_NumWorkGroups.x +
                   gl_WorkGroupID.x;
    bool cluster_exists = cluster <= last_triangle / cluster_triangles;
    uint triangle = cluster * cluster_triangles + lane;
    bool drawn = triangle >= constants.first_triangle && triangle <= last_triangle;
    uvec4 corners = drawn ? triangle_at(triangle) : uvec4(0u);
    vec3 a = posed_vertex_at(corners.x).position;
    vec3 b = posed_vertex_at(corners.y).position;
    vec3 c = posed_vertex_at(corners.z).position;
    uint end = constants.first_view + constants.view_count;
    for (uint first = constants.first_view; first < end; first += cluster_triangles) {
        if (lane < cluster_triangles / 32u) {
            showing[lane] = 0u;
        }
        barrier();
        if (cluster_exists && first + lane < end &&
            may_show(bounds[cluster], constants.groups, views[first + lane])) {
            atomicOr(showing[lane >> 5], 1u << (lane & 31u));
        }
        barrier();
        for (uint word = 0u; word < cluster_triangles / 32u; ++word) {
            uint bits = drawn ? showing[word] : 0u;
            while (bits != 0u) {
                uint bit = uint(findLSB(bits));
                bits &= bits - 1u;
                draw_into(first + word * 32u + bit, triangle, corners.w, a, b, c);
            }
        }
        barrier();
    }
}
