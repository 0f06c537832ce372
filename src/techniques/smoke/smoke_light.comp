// SPDX-License-Identifier: MIT
// One thread a cell of the light's grid: what share of all light gets there through the smoke. Each light is
// followed back through it once a picture, not once a sample of a ray.
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
layout(binding = 2, r16f) writeonly uniform image2DArray out_light;

#include "techniques/smoke/smoke_grid.glsl"

const float stride = 1.5;    // cells
const int most_strides = 96; // farther off, smoke throws no shadow

// What of a light is left when it has come to `place` through the smoke, `distance` cells before it.
float left_of_light(vec3 place, vec3 towards, float distance)
{
    float reach = min(range_in_box(place, towards).y, distance);
    int count = clamp(int(ceil(reach / stride)), 1, most_strides);
    float way = min(reach, stride * float(count)) / float(count);
    float dense = 0.0;
    for (int i = 0; i < rounds(count, int(place.x)); ++i) {
        dense += sample_layers(shape, place + (float(i) + 0.5) * way * towards, vec3(smoke.cells));
    }
    return exp(-dense * way * smoke.cell_m * smoke.extinction_per_m);
}

// Inverse square, windowed to reach zero at the range; nothing beside a spot's cone.
float arrives(SmokeLight light, vec3 towards, float distance)
{
    float distance_m = distance * smoke.cell_m;
    float ratio = distance_m / light.range_m;
    float window = clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
    float cone = clamp(light.cone_scale * dot(-towards, light.beam) + light.cone_offset, 0.0, 1.0);
    return min(light.falloff * window * cone * cone / max(distance_m * distance_m, 1e-6), 4.0);
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    ivec3 size = ivec3((smoke.cells + smoke_light_cells - 1u) / smoke_light_cells);
    if (any(greaterThanEqual(cell, size))) {
        return;
    }
    vec3 place = (vec3(cell) + 0.5) * float(smoke_light_cells);
    float sum = smoke.ambient;
    for (uint i = 0u; i < smoke.light_count; ++i) {
        SmokeLight light = smoke.lights[i];
        bool is_near = light.range_m > 0.0;
        vec3 way = is_near ? light.place - place : light.place;
        float distance = is_near ? max(length(way), 1e-3) : 1e9;
        vec3 towards = is_near ? way / distance : way;
        float share = light.strength * (is_near ? arrives(light, towards, distance) : 1.0);
        sum += share * left_of_light(place, towards, distance);
    }
    imageStore(out_light, cell, vec4(sum));
}
