// SPDX-License-Identifier: MIT
// One thread a cell of a volume: vorticity in its middle, of unit cells, component by component, and how much
// it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform sampler2DArray velocity;
layout(binding = 1, r32f) writeonly uniform image2DArray out_curl;

layout(push_constant, scalar) uniform Constants
{
    FluidGrid grid;
};

#include "techniques/fluid/fluid_fields.glsl"

float speed_in(ivec3 cell, int component)
{
    int first = component * int(grid.depth);
    ivec3 next = neighbour(cell, component, 1);
    return 0.5 * (texelFetch(velocity, ivec3(cell.xy, first + cell.z), 0).x +
                  texelFetch(velocity, ivec3(next.xy, first + next.z), 0).x);
}

// How much a component grows from cell to cell along an axis.
float growth(ivec3 cell, int component, int axis)
{
    return 0.5 *
           (speed_in(neighbour(cell, axis, 1), component) - speed_in(neighbour(cell, axis, -1), component));
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (!is_in_grid(cell)) {
        return;
    }
    vec3 whole;
    for (int i = 0; i < 3; ++i) {
        int next = (i + 1) % 3;
        int last = (i + 2) % 3;
        whole[i] = growth(cell, last, next) - growth(cell, next, last);
        imageStore(out_curl, ivec3(cell.xy, i * int(grid.depth) + cell.z), vec4(whole[i]));
    }
    imageStore(out_curl, ivec3(cell.xy, 3 * int(grid.depth) + cell.z), vec4(length(whole)));
}
