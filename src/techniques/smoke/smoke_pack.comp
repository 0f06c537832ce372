// SPDX-License-Identifier: MIT
// One workgroup handles one brick (block of cells). It packs density and light of a cell and of its neighbour
// along z into one texel. So one filtered lookup interpolates between eight cells. The workgroup also stores
// the brick's highest density.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_several = (variant & smoke_has_several) != 0u;
const bool has_fire = (variant & smoke_has_fire) != 0u;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 1) uniform sampler2DArray shape;
layout(binding = 2) uniform sampler2DArray light;
layout(binding = 3) uniform sampler2DArray fire; // fire of the smoke box, for smoke_has_fire
layout(binding = 4, rgba16f) writeonly uniform image2DArray out_packed;

layout(scalar, binding = 5) writeonly buffer Bricks
{
    float out_densest[];
};

layout(push_constant, scalar) uniform Constants
{
    SmokeTurn turn;
};

#include "techniques/smoke/smoke_grid.glsl"

shared uint densest; // largest density as float bits; non-negative floats sort like their bits

float shape_at(ivec3 cell)
{
    ivec3 within = min(cell, ivec3(smoke.boxes[turn.box].cells) - 1);
    return texelFetch(shape, within + ivec3(0, 0, smoke.boxes[turn.box].first_layer), 0).x;
}

float light_at(ivec3 cell)
{
    uvec3 cells = smoke.boxes[turn.box].cells;
    ivec3 within = min(cell, ivec3(cells) - 1);
    vec3 place = (vec3(within) + 0.5) / float(smoke_light_cells);
    float share =
        sample_layers(light, place, vec3(light_counts(cells)), vec2(light_counts(smoke.field_cells).xy),
                      float(smoke.boxes[turn.box].first_layer / smoke_light_cells));
    return has_fire ? share + smoke_flame_light * texelFetch(fire, within, 0).x : share;
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
    for (int i = 0; i < loop_rounds(int(smoke_brick), low.x); ++i) {
        ivec3 cell = low + ivec3(0, 0, i);
        ivec3 above = cell + ivec3(0, 0, 1);
        vec2 there = vec2(shape_at(above), light_at(above));
        if (all(lessThan(cell, ivec3(smoke.boxes[turn.box].cells)))) {
            imageStore(out_packed, cell + ivec3(0, 0, smoke.boxes[turn.box].first_layer), vec4(here, there));
        }
        // An interpolation between the brick's cells and the cells beyond never exceeds the maximum of all
        // cells between which it interpolates.
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
        out_densest[brick_index(turn.box, gl_WorkGroupID)] = uintBitsToFloat(densest);
    }
}
