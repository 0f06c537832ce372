// SPDX-License-Identifier: MIT
// One thread draws the smoke of one pixel: flat tones inside the smoke's edge, strokes in shade, and a line
// at the edge or where one puff stands before another.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/lines.glsl"
#include "shaders/loops.glsl"
#include "shaders/stroke_field.glsl"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_ray.glsl"

layout(local_size_x = 8, local_size_y = 32) in;

layout(constant_id = 0) const uint variant = 0u;
const bool has_wash = (variant & smoke_has_wash) != 0u;
const bool has_strokes = (variant & smoke_has_strokes) != 0u;
const bool has_haze = (variant & smoke_has_haze) != 0u;
const bool has_fire = (variant & smoke_has_fire) != 0u;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Smoke
{
    SmokeGlobals smoke;
};

layout(binding = 2) uniform sampler2D smoke_image; // marched smoke, from smoke_march.comp
layout(binding = 3) uniform sampler2D depth_image;
layout(binding = 4) uniform sampler2D line_image;
layout(binding = 5) uniform sampler2D sky_image; // colour of the sky, for smoke_has_haze
layout(binding = 6, rgba8) writeonly uniform image2D out_paint;
layout(binding = 7, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    SmokeInk ink;
};

const int ways = 12; // number of directions in which a line searches for the smoke's edge

vec4 smoke_at(ivec2 pixel)
{
    return texelFetch(smoke_image, clamp(pixel, ivec2(0), ivec2(frame.size_px) - 1), 0);
}

float depth_at(ivec2 pixel)
{
    return texelFetch(depth_image, clamp(pixel, ivec2(0), ivec2(frame.size_px) - 1), 0).x;
}

vec3 point_at(ivec2 pixel, float away_m)
{
    Ray ray = ray_at(frame, vec2(pixel) + 0.5);
    return ray.origin + away_m * ray.direction;
}

// Antialiased coverage of the drawn smoke at its edge: 1 inside, 0 outside.
float cover_at(ivec2 pixel, float opacity)
{
    vec2 slope = 0.5 * vec2(smoke_at(pixel + ivec2(1, 0)).x - smoke_at(pixel - ivec2(1, 0)).x,
                            smoke_at(pixel + ivec2(0, 1)).x - smoke_at(pixel - ivec2(0, 1)).x);
    return clamp(0.5 + (opacity - smoke.edge) / max(length(slope), 0.02), 0.0, 1.0);
}

// Distance in pixels to the nearest place where the smoke ends, or where its depth jumps: there the smoke is
// farther from the eye by `gap_m` more than a steep slope allows. Places that the scene hides do not count.
float distance_to_end(ivec2 pixel, float surface_m, float own_depth, float pixel_m, float gap_m)
{
    const float steep = 3.0;
    float nearest = 1e9;
    int reach = int(ceil(1.5 * ink.line_px)) + 1;
    for (int i = 0; i < loop_rounds(ways * reach, pixel.x); ++i) {
        float angle = 6.2831853 * (float(i % ways) + 0.5) / float(ways);
        ivec2 aside = ivec2(round(float(1 + i / ways) * vec2(cos(angle), sin(angle))));
        vec4 there = smoke_at(pixel + aside);
        float away = length(vec2(aside));
        bool is_end = there.x < smoke.edge || there.z > surface_m + gap_m + steep * pixel_m * away;
        bool is_open = depth_at(pixel + aside) <= own_depth;
        nearest = is_end && is_open ? min(nearest, away) : nearest;
    }
    return nearest;
}

// Share of the smoke's ink that stays visible beside contour lines of objects in front of the smoke. Half of
// an outline's width lies beyond its object.
float left_by_scene(ivec2 pixel, float own_depth)
{
    float line = texelFetch(line_image, pixel, 0).a;
    float nearest = 0.0;
    for (int i = 0; i < loop_rounds(16, pixel.x); ++i) {
        float angle = 6.2831853 * float(i & 7) / 8.0;
        float reach = (i < 8 ? 0.5 : 1.0) * (ink.scene_line_px + 1.0);
        nearest = max(nearest, depth_at(pixel + ivec2(round(reach * vec2(cos(angle), sin(angle))))));
    }
    return nearest > own_depth ? 1.0 - line : 1.0;
}

// Change of the smoke surface's position from one pixel to the next: the mean of the changes on both sides,
// if the puff continues on both sides.
vec3 step_along(ivec2 pixel, ivec2 way, vec3 point, float surface_m, float gap_m)
{
    float after_m = smoke_at(pixel + way).z;
    float before_m = smoke_at(pixel - way).z;
    bool has_after = after_m > 0.0 && abs(after_m - surface_m) < gap_m;
    bool has_before = before_m > 0.0 && abs(before_m - surface_m) < gap_m;
    vec3 after = point_at(pixel + way, has_after ? after_m : surface_m);
    vec3 before = point_at(pixel - way, has_before ? before_m : surface_m);
    return has_after == has_before ? 0.5 * (after - before) : has_after ? after - point : point - before;
}

float strokes_at(ivec2 pixel, vec3 point, float surface_m, float dark, uint box)
{
    float gap_m = smoke.boxes[box].gap_m;
    Footprint f = Footprint(step_along(pixel, ivec2(1, 0), point, surface_m, gap_m),
                            step_along(pixel, ivec2(0, 1), point, surface_m, gap_m));
    vec3 axis = ink.stroke_axis;
    vec3 side = unit(cross(axis, abs(axis.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
    vec3 risen = vec3(0.0, smoke.boxes[box].stroke_rise_m, 0.0);
    LineField field = field_along(axis, side, cross(axis, side), point - risen, f);
    // On a puff's edge, where its surface turns away from the eye, strokes would crowd into black.
    float pixel_m = pixel_size_m(frame, point);
    field.v_per_px = clamp(field.v_per_px, 0.2 * pixel_m, 3.0 * pixel_m);
    float pen = ink.stroke_px;
    HatchLineStyle style = HatchLineStyle(pen, 0.4 * pen, 10.0 * pen, 30.0 * pen, 90.0 * pen, 0.3, 0.0);
    return line_ink(field, style, dark, smoke.boxes[box].seed + 5u);
}

// Share of flame in the visible smoke, computed from its light.
float flame_share(float light)
{
    return smoothstep(0.04, 0.16, light / smoke_flame_light);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec4 here = smoke_at(pixel);
    vec4 paint = vec4(1.0, 1.0, 1.0, 0.0);
    float inked = 0.0;
    if (here.z > 0.0) {
        uint box = uint(0.5 * here.w);
        float facing = here.w - 2.0 * float(box);
        vec3 point = point_at(pixel, here.z);
        vec4 clip = frame.clip_from_anchor * vec4(point, 1.0);
        float own_depth = clip.z / clip.w;
        float left = left_by_scene(pixel, own_depth);
        float cover = cover_at(pixel, here.x);
        float light = here.y * mix(1.0, smoothstep(0.05, 0.75, facing), ink.form);
        float end_px =
            distance_to_end(pixel, here.z, own_depth, pixel_size_m(frame, point), smoke.boxes[box].gap_m);
        float pen_px = ink.line_px * mix(1.5, 0.6, smoothstep(0.2, 0.9, light));
        inked = clamp(pen_px - end_px + 1.0, 0.0, 1.0) * cover;
        float shade = smoothstep(0.04, -0.04, light - ink.shade_below);
        float deep = smoothstep(0.04, -0.04, light - ink.deep_below);
        float dark = has_strokes ? ink.darkness * mix(0.6 * shade, 1.0, deep) : 0.0;
        if (dark > 0.0) {
            inked = max(inked, cover * strokes_at(pixel, point, here.z, dark, box));
        }
        inked *= left;
        vec3 color = mix(mix(ink.color, ink.shade_color, shade), ink.deep_color, deep);
        color = has_wash ? color : ink.color;
        color = has_fire ? mix(color, ink.flame_color, flame_share(here.y)) : color;
        if (has_haze) {
            float away = frame.is_orthographic != 0u ? here.z : distance(point, frame.eye_anchor);
            float halved = max(away - ink.haze_start_m, 0.0) * ink.haze_halves_per_m;
            vec3 sky = texelFetch(sky_image, min(pixel, textureSize(sky_image, 0) - 1), 0).rgb;
            color = mix(sky, color, exp2(-halved));
            inked *= exp2(-ink.haze_ink * halved);
        }
        paint = vec4(color, cover * left * ink.opacity);
    }
    imageStore(out_paint, pixel, vec4(sqrt(paint.rgb), paint.a));
    imageStore(out_ink, pixel, vec4(inked));
}
