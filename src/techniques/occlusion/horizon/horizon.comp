// SPDX-License-Identifier: MIT
// One thread per pixel of the half page (every second pixel) estimates ambient visibility from the depths
// around it. Along slices through the view ray, each step blocks the sectors of the hemisphere between the
// front and the back of the occluder. Each slice has four masks, for occluders within four radii, so that
// farther occluders count less. The back lies at an assumed distance behind the front. With HAS_BACKS, the
// back is read from a second depth image, and the assumed distance only serves open sheets.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
#include "shaders/loops.glsl"
#include "techniques/occlusion/horizon/horizon.glsl.h"
#include "techniques/occlusion/horizon/horizon.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#include "shaders/frame.glsl.h"

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform usampler2D normal_image;
#ifdef HAS_BACKS
layout(binding = 3) uniform sampler2D back_image; // depth where the view ray leaves the body, or 0
layout(binding = 4, rg32ui) writeonly uniform uimage2D out_open; // visibility and depth, as float bits
#else
layout(binding = 3, rg32ui) writeonly uniform uimage2D out_open; // visibility and depth, as float bits
#endif

layout(push_constant, scalar) uniform Constants
{
    HorizonConstants constants;
};

#include "techniques/occlusion/half_page.glsl"

// Order of the sampling directions in a pattern of 4 x 4 pixels, chosen so that neighbours differ most.
const uint pattern_order[16] = uint[](0u, 8u, 2u, 10u, 12u, 4u, 14u, 6u, 3u, 11u, 1u, 9u, 15u, 7u, 13u, 5u);

// Part of a slice (half plane through the view ray) that an occluder blocks, from its front to its back. The
// part is given as positions over the hemisphere; 0 is the horizon on the opposite side. The function uses a
// slice through the occluder's pixel centre, because pixel centres lie beside the step's line. So occluders
// in the surface's plane lie exactly at the surface's horizon. `way` leads to the occluder's front; `x` is
// its length across the view ray, and `z_both` the positions of front and back along the view ray.
vec2 hidden_by(vec3 way, vec3 normal, vec3 eye, float up, float x, vec2 z_both)
{
    float aside = (dot(way, normal) - dot(way, eye) * up) / x;
    float share = inversesqrt(up * up + aside * aside);
    float cos_n = up * share;
    float sin_n = aside * share;
    float n = atan(aside, up);
    float other = slice_light_whole(-n, cos_n, -sin_n);
    float here = slice_light_whole(n, cos_n, sin_n);
    vec2 inverse = inversesqrt(x * x + z_both * z_both);
    vec2 cosine = z_both * inverse;
    vec2 sine = x * inverse;
    vec2 angle = acos(clamp(cosine, -1.0, 1.0));
    float horizon = n + 1.57079633;
    float front = slice_light(angle.x, cosine.x, sine.x, cos_n, sin_n);
    float back = slice_light(angle.y, cosine.y, sine.y, cos_n, sin_n);
    vec2 light = vec2(angle.x < horizon ? front : here, angle.y < horizon ? back : here);
    return (other + light) / (other + here);
}

const float hides_from = 0.98; // an occluder beyond the position 0.98 may be the surface itself

void main()
{
    ivec2 half_pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(half_pixel), constants.half_px))) {
        return;
    }
    ivec2 pixel = whole_pixel(half_pixel);
    float depth = texelFetch(depth_image, pixel, 0).x;
    // The pattern is fixed to the page, independent of tiles: 16 pixels together cover all directions.
    uvec2 place = (uvec2(half_pixel) + constants.from_half) % horizon_pattern;
    uint rank = pattern_order[place.y * horizon_pattern + place.x];
    float turn = (float(rank) + 0.5) / 16.0;
    float ahead = (float((5u * rank + 3u) % 16u) + 0.5) / 16.0;
    float shift = 0.9 * ((float((11u * rank + 7u) % 16u) + 0.5) / 16.0 - 0.5);

    vec2 middle_px = vec2(pixel) + 0.5;
    if (depth <= 0.0) {
        imageStore(out_open, half_pixel, uvec4(floatBitsToUint(1.0), 0u, 0u, 0u));
        return;
    }
    vec4 seen =
        frame.anchor_from_clip * vec4(ndc_at(page_place(frame, middle_px), frame.page_px), depth, 1.0);
    vec3 point = seen.xyz / seen.w;
    vec4 per_px_x = frame.anchor_from_clip[0] * (2.0 / float(frame.page_px.x));
    vec4 per_px_y = frame.anchor_from_clip[1] * (2.0 / float(frame.page_px.y));
    vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
    vec3 eye = towards_eye(frame, point);
    float pixel_m = pixel_size_m(frame, point);
    float radius_px = min(constants.radius_m / pixel_m, constants.reach_px);
    float radius_m = radius_px * pixel_m;
    vec4 radii_2 = radius_m * radius_m * (vec4(0.0, 1.0, 2.0, 3.0) + ahead) / 4.0;

    float up = max(dot(normal, eye), 0.02);
    float arriving = 0.0;
    float whole = 0.0;
    for (uint slice = 0u; slice < horizon_slices; ++slice) {
        float turned = 3.14159265 / float(horizon_slices) * (turn + float(slice));
        vec2 along_px = vec2(cos(turned), sin(turned));
        vec4 there = seen + per_px_x * along_px.x + per_px_y * along_px.y;
        vec3 along = there.xyz / there.w - point;
        along = unit(along - eye * dot(along, eye));
        float aside = dot(normal, along);
        float share = sqrt(up * up + aside * aside);
        float n = atan(aside, up);
        float weight = share * (slice_light_whole(n, up / share, aside / share) +
                                slice_light_whole(-n, up / share, -aside / share));
        uvec4 hidden = uvec4(0u);
        // Front of the previous step's occluder, on both sides; 1 is the surface's own horizon.
        vec2 fronts = vec2(1.0);
        for (int i = 0; i < loop_rounds(2 * int(horizon_steps), pixel.x); ++i) {
            float side = (i & 1) == 0 ? 1.0 : -1.0;
            float way = (float(i >> 1) + ahead) / float(horizon_steps);
            vec2 offset = side * along_px * max(way * sqrt(way) * radius_px, 1.0);
            ivec2 looked = ivec2(floor(middle_px + offset));
            ivec2 held = clamp(looked, ivec2(0), ivec2(frame.size_px) - 1);
            float occluder = texelFetch(depth_image, held, 0).x;
            bool counts = looked == held && occluder > 0.0 && looked != pixel;
            vec2 by = vec2(looked - pixel);
            vec4 at =
                seen + per_px_x * by.x + per_px_y * by.y + frame.anchor_from_clip[2] * (occluder - depth);
            vec3 way_there = counts ? at.xyz / at.w - point : normal;
            float distance_2 = dot(way_there, way_there);
            float z = dot(way_there, eye);
            float x = sqrt(max(distance_2 - z * z, 1e-16));
            vec2 z_both = vec2(z, z - constants.thickness * radius_m);
#ifdef HAS_BACKS
            float back = texelFetch(back_image, held, 0).x;
            if (counts && back > 0.0) {
                vec4 left_at =
                    seen + per_px_x * by.x + per_px_y * by.y + frame.anchor_from_clip[2] * (back - depth);
                z_both.y = dot(left_at.xyz / left_at.w - point, eye);
                // The body blocks only with its part within the radius, also where its front is farther away.
                float within_m = sqrt(max(radii_2.w - x * x, 0.0));
                float nearest_m = clamp(0.0, z_both.y, z_both.x);
                distance_2 = x * x + nearest_m * nearest_m;
                z_both = clamp(z_both, -within_m, within_m);
            }
#endif
            vec2 places = hidden_by(way_there, normal, eye, up, x, z_both);
            // A continuous surface ends, on average, half a step beyond its last sample.
            float before = side > 0.0 ? fronts.x : fronts.y;
            float front = places.x;
            places.x -= before < hides_from ? 0.5 * max(before - front, 0.0) : 0.0;
            front = counts ? front : 1.0;
            fronts = side > 0.0 ? vec2(front, fronts.y) : vec2(fronts.x, front);
            places = side > 0.0 ? places : 1.0 - places;
            uint sectors = sectors_between(min(places.x, places.y), max(places.x, places.y), shift);
            bvec4 within = lessThan(vec4(distance_2), counts ? radii_2 : vec4(0.0));
            hidden |= mix(uvec4(0u), uvec4(sectors), within);
        }
        ivec4 counts = bitCount(hidden);
        float closed = float(counts.x + counts.y + counts.z + counts.w) / (4.0 * float(horizon_sectors));
        arriving += weight * (1.0 - closed);
        whole += weight;
    }
    float open = radius_px < horizon_least_px ? 1.0 : arriving / whole;
    imageStore(out_open, half_pixel, uvec4(floatBitsToUint(vec2(open, depth)), 0u, 0u));
}
