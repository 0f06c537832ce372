// SPDX-License-Identifier: MIT
// A workgroup a brick: density and light of a cell and of the one above it along z in one texel, so that one
// filtered look-up is one between eight cells; and the densest that a brick has.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/rounds.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 1) uniform sampler2DArray shape;
layout(binding = 2) uniform sampler2DArray light;
layout(binding = 3, rgba16f) writeonly uniform image2DArray out_packed;

layout(scalar, binding = 4) writeonly buffer Bricks
{
    float out_densest[];
};

#include "techniques/smoke/smoke_grid.glsl"

shared uint densest; // floats that are not negative order as their bits do

float shape_at(ivec3 cell)
{
    return texelFetch(shape, min(cell, ivec3(smoke.cells) - 1), 0).x;
}

float light_at(ivec3 cell)
{
    vec3 size = vec3((smoke.cells + smoke_light_cells - 1u) / smoke_light_cells);
    return sample_layers(light, (vec3(min(cell, ivec3(smoke.cells) - 1)) + 0.5) / float(smoke_light_cells),
                         size);
}

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        densest = 0u;
    }
    barrier();
    ivec3 low = ivec3(gl_GlobalInvocationID.xy, gl_WorkGroupID.z * smoke_brick);
    float most = 0.0;
    vec2 here = vec2(shape_at(low), light_at(low));
    for (int i = 0; i < rounds(int(smoke_brick), low.x); ++i) {
        ivec3 cell = low + ivec3(0, 0, i);
        ivec3 above = cell + ivec3(0, 0, 1);
        vec2 there = vec2(shape_at(above), light_at(above));
        if (all(lessThan(cell, ivec3(smoke.cells)))) {
            imageStore(out_packed, cell, vec4(here, there));
        }
        // Between a brick's cells and the next ones there is no more than in both.
        float beside = max(max(shape_at(cell + ivec3(1, 0, 0)), shape_at(cell + ivec3(0, 1, 0))),
                           shape_at(cell + ivec3(1, 1, 0)));
        float beyond = max(max(shape_at(cell + ivec3(1, 0, 1)), shape_at(cell + ivec3(0, 1, 1))),
                           shape_at(cell + ivec3(1, 1, 1)));
        most = max(max(most, max(here.x, there.x)), max(beside, beyond));
        here = there;
    }
    atomicMax(densest, floatBitsToUint(most));
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        uvec3 counts = brick_counts();
        uvec3 brick = gl_WorkGroupID;
        out_densest[(brick.z * counts.y + brick.y) * counts.x + brick.x] = uintBitsToFloat(densest);
    }
}
