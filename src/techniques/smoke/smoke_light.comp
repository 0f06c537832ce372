// SPDX-License-Identifier: MIT
// One thread per cell of the light grid: the share of all light that reaches the cell past the scene and
// through the smoke. Each light is traced once per picture, not once per sample of a view ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#include "shaders/frame.glsl.h"
#include "shaders/light_variant.glsl.h"
#include "techniques/shadow/shadow.glsl.h"
#include "techniques/smoke/smoke.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_several = (variant & smoke_has_several) != 0u;
const bool is_shaded = (variant & smoke_is_shaded) != 0u;
const bool has_sun_levels = (variant & light_has_sun_levels) != 0u;
const bool has_sun_warp = (variant & light_has_sun_warp) != 0u;
const bool has_soft_sun = false;

layout(scalar, binding = 0) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 1) uniform sampler2DArray shape;

// The frame's constants, read only for smoke_is_shaded.
layout(scalar, binding = 2) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 3) uniform samplerBuffer sun_map;

layout(scalar, binding = 4) uniform Sun
{
    SunShadow sun_shadow;
};

layout(scalar, binding = 5) readonly buffer LocalShadows
{
    LocalShadow local_shadows[];
};

layout(binding = 6) uniform samplerBuffer local_maps;

layout(binding = 7, r16f) writeonly uniform image2DArray out_light;

layout(push_constant, scalar) uniform Constants
{
    SmokeTurn turn;
};

#include "techniques/shadow/local/local_shadow.glsl"
#include "techniques/shadow/sun/sun_shadow.glsl"
#include "techniques/smoke/smoke_grid.glsl"

const float stride = 1.5;    // distance between two samples towards a light, in cells
const int most_strides = 96; // number of strides beyond which smoke casts no shadow on smoke

// Optical depth of a smoke box along a ray of at most `distance` cells.
float depth_through(uint number, vec3 origin, vec3 direction, float distance)
{
    vec3 cells = vec3(smoke.boxes[number].cells);
    vec2 range = range_in_box(cells, origin, direction);
    float from = max(range.x, 0.0);
    float reach = min(range.y, distance) - from;
    if (reach <= 0.0) {
        return 0.0;
    }
    int count = clamp(int(ceil(reach / stride)), 1, most_strides);
    float way = min(reach, stride * float(count)) / float(count);
    float dense = 0.0;
    for (int i = 0; i < count; i += 4) {
        [[unroll]] for (int k = 0; k < 4; ++k) // unrolled, so that four texel reads are under way at a time
        {
            vec3 place = origin + (from + (float(min(i + k, count - 1)) + 0.5) * way) * direction;
            float there = sample_layers(shape, place, cells, vec2(smoke.field_cells.xy),
                                        float(smoke.boxes[number].first_layer));
            dense += i + k < count ? there : 0.0;
        }
    }
    return dense * way * smoke.boxes[number].cell_m * smoke.boxes[number].extinction_per_m;
}

// Share of light that the smoke lets through between `place` and a light at `distance` cells.
float left_of_light(vec3 place, vec3 towards, float distance)
{
    float depth = depth_through(turn.box, place, towards, distance);
    if (has_several) {
        vec3 there = (smoke.boxes[turn.box].anchor_from_grid * vec4(place, 1.0)).xyz;
        vec3 way = mat3(smoke.boxes[turn.box].anchor_from_grid) * towards;
        for (int i = 0; i < int(smoke.box_count); ++i) {
            vec3 direction = mat3(smoke.boxes[i].grid_from_anchor) * way;
            float cells_per_cell = length(direction);
            vec3 origin = (smoke.boxes[i].grid_from_anchor * vec4(there, 1.0)).xyz;
            if (uint(i) != turn.box) {
                depth +=
                    depth_through(uint(i), origin, direction / cells_per_cell, distance * cells_per_cell);
            }
        }
    }
    return exp(-depth);
}

// Share of a light that arrives at a distance: inverse square, windowed to reach zero at the range; zero
// outside a spot's cone.
float arrives(SmokeLight light, vec3 towards, float distance)
{
    float distance_m = distance * smoke.boxes[turn.box].cell_m;
    float ratio = distance_m / light.range_m;
    float window = clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
    float cone = clamp(light.cone_scale * dot(-towards, light.beam) + light.cone_offset, 0.0, 1.0);
    return min(light.falloff * window * cone * cone / max(distance_m * distance_m, 1e-6), 4.0);
}

// Share of a light that the scene's shadow maps let through to a place. Smoke has no surface, so the shadow
// bias offsets the place towards the light.
float left_by_scene(SmokeLight light, vec3 place, vec3 towards)
{
    mat4 anchor_from_grid = smoke.boxes[turn.box].anchor_from_grid;
    vec3 point = (anchor_from_grid * vec4(place, 1.0)).xyz;
    vec3 way = normalize(mat3(anchor_from_grid) * towards);
    if (light.shadow == smoke_sun_shadow) {
        return sun_visibility(point, way, way);
    }
    if (light.shadow >= smoke_local_shadow) {
        vec3 position = (anchor_from_grid * vec4(light.place, 1.0)).xyz;
        return local_visibility(local_shadows[light.shadow - smoke_local_shadow], position, point, way);
    }
    return 1.0;
}

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    ivec3 size = ivec3(light_counts(smoke.boxes[turn.box].cells));
    if (any(greaterThanEqual(cell, size))) {
        return;
    }
    vec3 place = (vec3(cell) + 0.5) * float(smoke_light_cells);
    float sum = smoke.boxes[turn.box].ambient;
    for (uint i = 0u; i < smoke.boxes[turn.box].light_count; ++i) {
        SmokeLight light = smoke.boxes[turn.box].lights[i];
        bool is_near = light.range_m > 0.0;
        vec3 way = is_near ? light.place - place : light.place;
        float distance = is_near ? max(length(way), 1e-3) : 1e9;
        vec3 towards = is_near ? way / distance : way;
        float share = light.strength * (is_near ? arrives(light, towards, distance) : 1.0);
        share *= is_shaded ? left_by_scene(light, place, towards) : 1.0;
        sum += share * left_of_light(place, towards, distance);
    }
    int first_layer = int(smoke.boxes[turn.box].first_layer / smoke_light_cells);
    imageStore(out_light, cell + ivec3(0, 0, first_layer), vec4(sum));
}
