// SPDX-License-Identifier: MIT
// One thread per triangle: draws a small triangle whole, and lists a large one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require

#include "shaders/loops.glsl"
#include "techniques/raster/compute/raster.glsl"

layout(local_size_x = cluster_triangles) in;

#ifdef RASTER_LISTED
#include "shaders/tiles.glsl.h"

layout(scalar, binding = 6) readonly buffer Clusters
{
    uint clusters[]; // list of clusters in the format of tiles.glsl.h: one workgroup per cluster
};

// Number of the thread's triangle within the batch; beyond the batch's end if there is no triangle for the
// thread.
uint triangle_of_thread()
{
    uint number = gl_WorkGroupID.y * tile_list_groups + gl_WorkGroupID.x;
    uint count = clusters[tile_list_count];
    uint cluster = clusters[tile_list_first + min(number, count - 1u)];
    uint triangle = cluster * cluster_triangles + gl_LocalInvocationIndex;
    return number < count ? triangle - constants.first_triangle : ~0u;
}
#else
uint triangle_of_thread()
{
    return item_index();
}
#endif

void main()
{
    uint index = triangle_of_thread();
    if (index >= constants.triangle_count) {
        return;
    }
    uint triangle = constants.first_triangle + index;
    uint flags = triangle_at(triangle).w;
    ClippedTriangle clipped = load_clipped(triangle);
    draw_part(clipped, 0u, 0u, triangle, flags);
    if (clipped.count == 4) {
        draw_part(clipped, 1u, 0u, triangle, flags);
    }
}
