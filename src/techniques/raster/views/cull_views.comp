// SPDX-License-Identifier: MIT
// One thread per cluster: finds the views that may show it, and lists each pair for the hardware path.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/raster/clusters/view_cull.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Views
{
    RasterView views[];
};

layout(scalar, binding = 1) readonly buffer Bounds
{
    ClusterBounds bounds[];
};

layout(scalar, binding = 2) writeonly buffer List
{
    ClusterInView list[];
};

// Arguments of the hardware path's indirect draw call.
layout(scalar, binding = 3) buffer Arguments
{
    uint vertex_count;
    uint instance_count;
    uint first_vertex;
    uint first_instance;
};

layout(push_constant, scalar) uniform Constants
{
    ViewsConstants constants;
};

void main()
{
    uint first_cluster = constants.first_triangle / cluster_triangles;
    uint last_triangle = constants.first_triangle + constants.triangle_count - 1u;
    uint cluster = first_cluster + item_index();
    if (item_index() == 0u) {
        vertex_count = 3u * cluster_triangles;
    }
    if (cluster > last_triangle / cluster_triangles) {
        return;
    }
    ClusterBounds box = bounds[cluster];
    for (uint i = constants.first_view; i < constants.first_view + constants.view_count; ++i) {
        if (may_show(box, constants.groups, views[i])) {
            list[atomicAdd(instance_count, 1u)] = ClusterInView(cluster, i);
        }
    }
}
