// SPDX-License-Identifier: MIT
// One thread per cell of a 3D fluid: vorticity at the cell centre, for cells of size 1, and the vorticity's
// magnitude. A value between two faces along an axis is the mean of the two faces' values.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1, rgba16f) writeonly uniform image2DArray out_curl;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"

// Velocities on four faces of `component` in a slice, from `low` on, x varying fastest, then y.
vec4 faces(int component, ivec2 low, int slice)
{
    int inside = layer_of_slice(slice);
    vec4 nodes = plane_nodes(velocity, component, low, component * int(grid.depth) + inside);
    if (is_periodic(2) || inside == slice) {
        return nodes;
    }
    bool is_high = slice > 0;
    return component == 2 ? vec4(0.0)
                          : vec4(beyond_wall(nodes.xy, component, 2, is_high),
                                 beyond_wall(nodes.zw, component, 2, is_high));
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    ivec2 low = cell.xy - 1;
    ivec2 right = low + ivec2(1, 0);
    ivec2 above = low + ivec2(0, 1);
    vec4 x_behind = faces(0, cell.xy, cell.z - 1);
    vec4 x_below = faces(0, right, cell.z);
    vec4 x_here = faces(0, cell.xy, cell.z);
    vec4 x_before = faces(0, cell.xy, cell.z + 1);
    vec4 y_behind = faces(1, cell.xy, cell.z - 1);
    vec4 y_left = faces(1, above, cell.z);
    vec4 y_here = faces(1, cell.xy, cell.z);
    vec4 y_before = faces(1, cell.xy, cell.z + 1);
    vec4 z_low = faces(2, low, cell.z) + faces(2, low, cell.z + 1);
    vec4 z_here = faces(2, cell.xy, cell.z) + faces(2, cell.xy, cell.z + 1);
    float y_along_x = y_here.y + y_here.w - y_left.x - y_left.z;
    float x_along_y = x_here.z + x_here.w - x_below.x - x_below.y;
    float x_along_z = x_before.x + x_before.y - x_behind.x - x_behind.y;
    float y_along_z = y_before.x + y_before.z - y_behind.x - y_behind.z;
    float z_along_x = z_here.y - z_low.z;
    float z_along_y = z_here.z - z_low.y;
    vec3 whole = 0.25 * vec3(z_along_y - y_along_z, x_along_z - z_along_x, y_along_x - x_along_y);
    imageStore(out_curl, cell, vec4(whole, length(whole)));
}
