// SPDX-License-Identifier: MIT
// One thread per cluster of a batch: lists the cluster if the page may show any of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/raster/clusters/view_cull.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Bounds
{
    ClusterBounds bounds[];
};

#define TILE_LIST_BINDING 1
#include "shaders/tile_list_fill.glsl"

#include "techniques/raster/clusters/seen_clusters.glsl"

layout(push_constant, scalar) uniform Constants
{
    RasterConstants constants;
};

shared uint listed; // number of clusters that the workgroup adds to the list
shared uint first;  // index in the list of the workgroup's first cluster

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        listed = 0u;
    }
    barrier();
    uint cluster = constants.first_triangle / cluster_triangles + item_index();
    uint last = (constants.first_triangle + constants.triangle_count - 1u) / cluster_triangles;
    bool is_shown = cluster <= last && is_in_sight(cluster) &&
                    may_show(bounds[min(cluster, last)], constants.clip_from_anchor);
    uint number = is_shown ? atomicAdd(listed, 1u) : 0u;
    barrier();
    if (gl_LocalInvocationIndex == 0u && listed > 0u) {
        first = list_room(listed);
    }
    barrier();
    if (is_shown) {
        tile_list[tile_list_first + first + number] = cluster;
    }
}
