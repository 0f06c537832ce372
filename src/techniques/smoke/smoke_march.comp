// SPDX-License-Identifier: MIT
// One thread a pixel goes through the box from front to back, as far as what is seen there: how much the
// smoke hides, how bright it is, and where it is dense enough to be drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/hash.glsl"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint variant = 0u;
const bool by_axis = (variant & smoke_by_axis) != 0u;
const bool by_view = (variant & smoke_by_view) != 0u;
const bool by_slices = by_axis || by_view;

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
layout(binding = 5, rgba32f) writeonly uniform image2D out_smoke;

#include "techniques/smoke/smoke_grid.glsl"

const float least_left = 5e-5; // of what is behind: less is not looked for

// Density and light.
vec2 smoke_at(vec3 place)
{
    float z = clamp(place.z - 0.5, 0.0, float(smoke.cells.z) - 1.0);
    float low = floor(z);
    vec4 both = textureLod(packed, vec3(place.xy / vec2(smoke.cells.xy), low), 0.0);
    return mix(both.xy, both.zw, z - low);
}

// How far, in the ray's lengths, a ray stays in a brick that is empty; 0 where it is not.
float empty_way(vec3 place, vec3 direction)
{
    vec3 node = clamp(place - 0.5, vec3(0.0), vec3(smoke.cells) - 1.0);
    uvec3 counts = brick_counts();
    uvec3 brick = min(uvec3(node) / smoke_brick, counts - 1u);
    float densest = texelFetch(brick_texels, int((brick.z * counts.y + brick.y) * counts.x + brick.x)).x;
    vec3 low = vec3(brick * smoke_brick) + 0.5;
    vec3 plane = mix(low, low + float(smoke_brick), greaterThan(direction, vec3(0.0)));
    vec3 way = (plane - place) / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    // Beyond the outermost planes nothing changes any more.
    way = mix(way, vec3(1e9), lessThanEqual(way, vec3(0.0)));
    return densest > 0.0 ? 0.0 : min(way.x, min(way.y, way.z));
}

// Where samples lie along a ray: the i-th from `first` on, `spacing` apart.
struct Samples {
    float first;
    float spacing;
};

// Planes stand fast in the grid, across the axis that the eye looks along most, or across the view.
Samples samples_of(Ray ray, vec3 direction, vec2 range)
{
    if (!by_slices) {
        return Samples(range.x, smoke.step_m);
    }
    vec3 view = mat3(smoke.grid_from_anchor) * frame.view_forward;
    vec3 size = abs(view);
    int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    vec3 origin = (smoke.grid_from_anchor * vec4(ray.origin, 1.0)).xyz;
    float planes_per_cell = smoke.cell_m / smoke.step_m;
    float start = by_axis ? origin[axis] * planes_per_cell
                          : dot(ray.origin - frame.eye_anchor, frame.view_forward) / smoke.step_m;
    float rate =
        by_axis ? direction[axis] * planes_per_cell : dot(ray.direction, frame.view_forward) / smoke.step_m;
    rate = abs(rate) < 1e-6 ? 1e-6 : rate;
    float at_entry = start + range.x * rate;
    float plane = rate > 0.0 ? ceil(at_entry) : floor(at_entry);
    return Samples((plane - start) / rate, 1.0 / abs(rate));
}

vec3 facing(vec3 place)
{
    const float aside = 1.0;
    vec3 slope = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec3 off = vec3(0.0);
        off[axis] = aside;
        slope[axis] = smoke_at(place - off).x - smoke_at(place + off).x;
    }
    return slope * inversesqrt(max(dot(slope, slope), 1e-12));
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 position = vec2(pixel) + 0.5;
    Ray ray = ray_at(frame, position);
    vec3 origin = (smoke.grid_from_anchor * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(smoke.grid_from_anchor) * ray.direction;
    vec2 range = range_in_box(origin, direction);
    float depth = texelFetch(depth_image, pixel, 0).x;
    float seen_m = depth > 0.0 ? dot(anchor_at(frame, position, depth) - ray.origin, ray.direction) : 1e9;
    range = vec2(max(range.x, 0.0), min(range.y, seen_m));
    float left = 1.0;
    float bright = 0.0;
    float surface_m = 0.0;
    if (range.x < range.y) {
        Samples samples = samples_of(ray, direction, range);
        uvec2 place_px = uvec2(page_place(frame, vec2(pixel)));
        float stray =
            by_slices ? 0.0 : 0.5 + smoke.scatter * (unit_float(hash(place_px.x, place_px.y)) - 0.5);
        float number = 0.0;
        float from = samples.first;
        while (from < range.y && left > least_left) {
            float way = by_slices ? samples.spacing : min(samples.spacing, range.y - from);
            vec3 place = origin + (from + stray * way) * direction;
            vec2 here = smoke_at(place);
            if (here.x > 0.0) {
                float thickness = here.x * smoke.extinction_per_m * way;
                float passed = exp(-thickness);
                float wanted = log(max(left, 1e-6) / (1.0 - smoke.edge));
                surface_m = surface_m == 0.0 && thickness >= wanted
                                ? max(from + way * clamp(wanted / thickness, 0.0, 1.0), 1e-6)
                                : surface_m;
                bright += left * (1.0 - passed) * here.y;
                left *= passed;
                number += 1.0;
            } else {
                number += max(floor(empty_way(place, direction) / samples.spacing), 1.0);
            }
            from = samples.first + number * samples.spacing;
        }
    }
    float opacity = 1.0 - left;
    vec4 found = vec4(opacity, bright / max(opacity, 1e-6), surface_m, 0.5);
    if (surface_m > 0.0) {
        found.w = 0.5 + 0.5 * dot(facing(origin + surface_m * direction), smoke.towards_light);
    }
    imageStore(out_smoke, pixel, found);
}
