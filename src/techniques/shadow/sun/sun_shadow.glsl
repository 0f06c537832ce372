// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_SHADOW
#define ESTAMPE_SUN_SHADOW

// Looks up the sun's shadow map. The including shader declares the uniform `SunShadow sun_shadow`; the map,
// `samplerBuffer sun_map`, with reversed depth row by row; `FrameGlobals frame`; and the constants
// `has_sun_levels` (the map is a clipmap), `has_sun_warp` (it is in perspective) and `has_soft_sun` (the sun
// is a disc).

#include "shaders/sun_disc.glsl"
#include "techniques/shadow/shadow.glsl.h"

// A position in the sun's shadow map, and the plane of the surface there.
struct SunPlace {
    vec2 texel;  // position in texels; texel centres are at whole numbers
    float depth; // clip z of the point; negative beyond the farthest caster
    float bias;
    vec2 gradient; // change of depth per texel in the surface's plane
    float texel_m;
    vec2 texels_per_m;
    uint level;
    bool inside;
};

// Depth of the sun's map at a texel. Outside the map, and on its border, there is no caster.
float sun_depth_at(ivec2 texel, uint level)
{
    if (has_sun_levels) {
        uvec2 place = uvec2(texel) & (sun_shadow.size - 1u);
        uint row = level * sun_shadow.size + place.y;
        return texelFetch(sun_map, int(row * sun_shadow.size + place.x)).x;
    }
    ivec2 inside = clamp(texel, ivec2(0), ivec2(sun_shadow.size) - 1);
    float depth = texelFetch(sun_map, inside.y * int(sun_shadow.size) + inside.x).x;
    if (has_sun_warp) {
        // In a perspective map, all depths of a row were divided by one common homogeneous coordinate w.
        float y = (2.0 * float(inside.y) + 1.0) / float(sun_shadow.size) - 1.0;
        depth *= sun_shadow.warp.y / (sun_shadow.warp.x - y);
    }
    return depth;
}

// The finest level of the sun's clipmap that can be read at `point`. The level is not finer than the page's
// pixels at the point, and its window contains the point with a margin of `margin_m`. Returns the number of
// levels if no level can be read.
uint sun_level(vec3 point, float margin_m)
{
    float away = frame.is_orthographic != 0u ? 1.0 : dot(point - frame.eye_anchor, frame.view_forward);
    float pixel_m = sun_shadow.pixel_m * max(away, frame.near_m);
    int last = int(sun_shadow.level_count) - 1;
    // With soft shadows, texels must be smaller than a pixel, because a penumbra one pixel wide needs more
    // than one texel.
    float wanted_m = has_soft_sun ? 0.5 * pixel_m : pixel_m;
    int wanted = clamp(int(floor(log2(wanted_m / sun_shadow.texel_m))), 0, last);
    vec2 at = vec2(dot(sun_shadow.right, point), dot(sun_shadow.down, point));
    int level = last + 1;
    for (int i = int(sun_levels) - 1; i >= 0; --i) {
        float texels_per_m = exp2(-float(i)) / sun_shadow.texel_m;
        vec2 inside = at * texels_per_m - vec2(sun_shadow.window_low[i]);
        float margin = margin_m * texels_per_m + 3.0;
        bool fits = all(greaterThan(inside, vec2(margin))) &&
                    all(lessThan(inside, vec2(float(sun_shadow.size) - margin)));
        level = fits && i >= wanted && i <= last ? i : level;
    }
    return uint(level);
}

// Share of the sun's shadow that remains at a point near the edge of the last clipmap level.
float sun_fade(vec3 point)
{
    vec3 way = point - frame.eye_anchor;
    vec2 away = abs(vec2(dot(sun_shadow.right, way), dot(sun_shadow.down, way)));
    float reach = float(sun_shadow.size) * sun_shadow.texel_m * exp2(float(sun_shadow.level_count) - 1.0);
    return 1.0 - sun_shadow.fade * smoothstep(0.3, 0.42, max(away.x, away.y) / reach);
}

// Position of a surface point in the sun's shadow map. `lift` raises the point along the normal, in texels;
// the lift is proportional to the surface's slant.
SunPlace sun_place(vec3 point, vec3 normal, vec3 towards_sun, float lift, float margin_m)
{
    SunPlace place;
    place.level = has_sun_levels ? sun_level(point, margin_m) : 0u;
    float coarser = has_sun_levels ? exp2(float(place.level)) : 1.0;
    place.texel_m = sun_shadow.texel_m * coarser;
    place.texels_per_m = sun_shadow.texels_per_m / coarser;
    if (has_sun_warp) {
        float w = max((sun_shadow.clip_from_anchor * vec4(point, 1.0)).w, 1e-3);
        place.texels_per_m = sun_shadow.texels_per_m / vec2(w, w * w);
        place.texel_m = 1.0 / min(place.texels_per_m.x, place.texels_per_m.y);
    }
    float facing = dot(normal, towards_sun);
    float slope = sqrt(max(0.0, 1.0 - facing * facing));
    vec3 lifted = point + normal * (place.texel_m * (0.4 + lift * slope));
    vec4 clip = sun_shadow.clip_from_anchor * vec4(lifted, 1.0);
    if (has_sun_warp) {
        clip.xy /= max(clip.w, 1e-3);
    }
    place.texel = (0.5 * clip.xy + 0.5) * float(sun_shadow.size) - 0.5;
    place.inside = all(greaterThanEqual(place.texel, vec2(0.0))) &&
                   all(lessThanEqual(place.texel, vec2(sun_shadow.size - 1u)));
    if (has_sun_levels) {
        place.texel =
            vec2(dot(sun_shadow.right, lifted), dot(sun_shadow.down, lifted)) * place.texels_per_m - 0.5;
        place.inside = place.level < sun_shadow.level_count;
        place.level = min(place.level, sun_shadow.level_count - 1u);
    }
    place.depth = clip.z;
    place.bias = place.texel_m / sun_shadow.depth_m;
    vec2 tilt = vec2(dot(normal, sun_shadow.right), dot(normal, sun_shadow.down));
    place.gradient = -tilt / (max(facing, 0.1) * place.texels_per_m * sun_shadow.depth_m);
    return place;
}

// Share of sunlight around `texel` for a surface point at `depth`: four depth comparisons, blended bilinearly
// (Reeves et al. 1987). Texels without a caster hold zero.
float sun_compare(SunPlace place, vec2 texel, float depth, vec2 gradient)
{
    ivec2 corner = ivec2(floor(texel));
    vec2 f = texel - vec2(corner);
    vec4 blocker = vec4(sun_depth_at(corner, place.level), sun_depth_at(corner + ivec2(1, 0), place.level),
                        sun_depth_at(corner + ivec2(0, 1), place.level),
                        sun_depth_at(corner + ivec2(1, 1), place.level));
    vec4 receiver = depth - dot(f, gradient) + vec4(0.0, gradient.x, gradient.y, gradient.x + gradient.y);
    vec4 lit = vec4(greaterThanEqual(max(receiver, 0.0) + place.bias, blocker));
    return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

// Share of a point-like sun that arrives at a surface point.
float sun_visibility(vec3 point, vec3 normal, vec3 towards_sun)
{
    SunPlace place = sun_place(point, normal, towards_sun, 1.8, 0.0);
    float share = place.inside ? sun_compare(place, place.texel, place.depth, vec2(0.0)) : 1.0;
    return has_sun_levels ? mix(1.0, share, sun_fade(point)) : share;
}

// Whether a place in the map gives a valid answer. Outside a map that covers all casters there is no shadow;
// outside a smaller map the shadow is unknown.
bool place_counts(SunPlace place)
{
    return (!has_sun_levels && !has_sun_warp) || place.inside;
}

// Largest lateral distance at which a caster can block part of the sun's disc.
float sun_reach_m(vec3 point)
{
    float depth = (sun_shadow.clip_from_anchor * vec4(point, 1.0)).z;
    return max(1.0 - depth, 0.0) * sun_shadow.depth_m * sun_shadow.sun_slope;
}

// Half width in metres, perpendicular to the sun, of the penumbra at `point`. The width is computed from the
// mean distance of blockers of some part of the sun (Fernando, "Percentage-Closer Soft Shadows", 2005). The
// width is 0 without blockers.
float sun_penumbra_m(vec3 point, vec3 normal, vec3 towards_sun)
{
    const uint count = 48u;
    float reach_m = sun_reach_m(point);
    SunPlace place = sun_place(point, normal, towards_sun, 0.0, reach_m);
    float sum = 0.0;
    float found = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 aside_m = reach_m * spiral(i, count, 0.6);
        vec2 aside = aside_m * place.texels_per_m;
        float plane = place.depth + dot(aside, place.gradient);
        float blocker = sun_depth_at(ivec2(round(place.texel + aside)), place.level);
        float above_m = (blocker - plane) * sun_shadow.depth_m;
        bool blocks = blocker > max(plane, 0.0) + place.bias &&
                      length(aside_m) <= above_m * sun_shadow.sun_slope + place.texel_m;
        sum += blocks ? above_m : 0.0;
        found += blocks ? 1.0 : 0.0;
    }
    return place_counts(place) && found > 0.0 ? sum / found * sun_shadow.sun_slope : 0.0;
}

// Share of the sun that arrives at a surface point, averaged over a disc of `radius_m` perpendicular to the
// sun.
float sun_soft_visibility(vec3 point, vec3 normal, vec3 towards_sun, float radius_m)
{
    const uint count = 48u;
    SunPlace place = sun_place(point, normal, towards_sun, 0.0, radius_m);
    float sum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 aside = radius_m * spiral(i, count, 0.5) * place.texels_per_m;
        sum +=
            sun_compare(place, place.texel + aside, place.depth + dot(aside, place.gradient), place.gradient);
    }
    float share = place_counts(place) ? sum / float(count) : 1.0;
    return has_sun_levels ? mix(1.0, share, sun_fade(point)) : share;
}

#endif
