// SPDX-License-Identifier: MIT
// One thread per pixel: the share of sunlight that the smoke lets through to the visible surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_ray.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_several = (variant & smoke_has_several) != 0u;
const bool has_share = (variant & smoke_has_share) != 0u;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 2) uniform sampler2DArray packed;
layout(binding = 3) uniform samplerBuffer brick_texels;
layout(binding = 4) uniform sampler2D depth_image;
// Share of sunlight that terrain and clouds let through, for smoke_has_share.
layout(binding = 5) uniform sampler2D share_image;
layout(binding = 6, r16f) writeonly uniform image2D out_share;

layout(push_constant, scalar) uniform Constants
{
    SmokeThrown thrown;
};

#include "techniques/smoke/smoke_grid.glsl"
#include "techniques/smoke/smoke_volume.glsl"

const float stride = 1.0; // distance between two samples, in cells
// Optical depth at which the march stops, because the remaining light is invisible.
const float most_depth = 8.0;

// Optical depth of a smoke box along a ray.
float depth_through(uint box, Ray ray)
{
    Ray within = ray_in_box(box, ray);
    vec2 range = range_in_box(vec3(smoke.boxes[box].cells), within.origin, within.direction);
    float step_m = stride * smoke.boxes[box].cell_m;
    float from = max(range.x, 0.0);
    float depth = 0.0;
    while (from < range.y && depth < most_depth) {
        float way = min(step_m, range.y - from);
        vec3 place = within.origin + (from + 0.5 * way) * within.direction;
        float dense = smoke_at(box, place).x;
        depth += dense * way * smoke.boxes[box].extinction_per_m;
        float empty_steps = dense > 0.0 ? 1.0 : empty_way(box, place, within.direction) / step_m;
        from += max(floor(empty_steps), 1.0) * step_m;
    }
    return depth;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    float seen = texelFetch(depth_image, pixel, 0).x;
    float depth = 0.0;
    if (seen > 0.0) {
        Ray ray = Ray(anchor_at(frame, vec2(pixel) + 0.5, seen), thrown.towards_sun);
        for (uint i = 0u; i < box_count(); ++i) {
            depth += depth_through(i, ray);
        }
    }
    float share = mix(1.0, exp(-depth), thrown.strength);
    imageStore(out_share, pixel, vec4(has_share ? share * texelFetch(share_image, pixel, 0).x : share));
}
