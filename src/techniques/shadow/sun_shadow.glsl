// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_SHADOW
#define ESTAMPE_SUN_SHADOW

// Looks the sun up in its map. Who includes this declares `SunShadow sun_shadow`, a uniform, and the map,
// `samplerBuffer sun_map`, reversed depth row by row.

#include "techniques/shadow/sun.glsl.h"

// A place in the map, and the plane of the surface there.
struct SunPlace {
    vec2 texel;  // centres have whole numbers
    float depth; // clip z; below 0 beyond the farthest caster
    float bias;
    vec2 gradient; // change of depth in the surface's plane over a texel
    bool inside;
};

// Beyond the map's rim, which is empty, there is no caster.
float sun_depth_at(ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), ivec2(sun_shadow.size) - 1);
    return texelFetch(sun_map, inside.y * int(sun_shadow.size) + inside.x).x;
}

// `lift` raises the point along the normal, in texels, by how slanted the surface is.
SunPlace sun_place(vec3 point, vec3 normal, vec3 towards_sun, float lift)
{
    float facing = dot(normal, towards_sun);
    float slope = sqrt(max(0.0, 1.0 - facing * facing));
    vec3 lifted = point + normal * (sun_shadow.texel_m * (0.4 + lift * slope));
    vec4 clip = sun_shadow.clip_from_anchor * vec4(lifted, 1.0);
    SunPlace place;
    place.texel = (0.5 * clip.xy + 0.5) * float(sun_shadow.size) - 0.5;
    place.inside = all(greaterThanEqual(place.texel, vec2(0.0))) &&
                   all(lessThanEqual(place.texel, vec2(sun_shadow.size - 1u)));
    place.depth = clip.z;
    place.bias = sun_shadow.texel_m / sun_shadow.depth_m;
    vec2 tilt = vec2(dot(normal, sun_shadow.right), dot(normal, sun_shadow.down));
    place.gradient = -tilt / (max(facing, 0.1) * sun_shadow.texels_per_m * sun_shadow.depth_m);
    return place;
}

// Share of light about `texel`, for a receiver as deep as `depth`: four comparisons, blended as a bilinear
// lookup would (Reeves et al. 1987). Texels that no caster covers hold zero.
float sun_compare(vec2 texel, float depth, vec2 gradient, float bias)
{
    ivec2 corner = ivec2(floor(texel));
    vec2 f = texel - vec2(corner);
    vec4 blocker = vec4(sun_depth_at(corner), sun_depth_at(corner + ivec2(1, 0)),
                        sun_depth_at(corner + ivec2(0, 1)), sun_depth_at(corner + ivec2(1, 1)));
    vec4 receiver = depth - dot(f, gradient) + vec4(0.0, gradient.x, gradient.y, gradient.x + gradient.y);
    vec4 lit = vec4(greaterThanEqual(max(receiver, 0.0) + bias, blocker));
    return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

// Share of a point sun that arrives.
float sun_visibility(vec3 point, vec3 normal, vec3 towards_sun)
{
    SunPlace place = sun_place(point, normal, towards_sun, 1.8);
    return place.inside ? sun_compare(place.texel, place.depth, vec2(0.0), place.bias) : 1.0;
}

// The i-th of a spiral of points that fill the unit disc (Vogel 1979): evenly for a power of a half, denser
// about the middle for a power of one.
vec2 spiral(uint i, uint count, float power)
{
    float radius = pow((float(i) + 0.5) / float(count), power);
    float angle = 2.3999632 * float(i);
    return radius * vec2(cos(angle), sin(angle));
}

// Half the breadth in metres, square to the sun, of the penumbra that `point` may lie in: that of the
// blockers which stand before some part of the sun, on average (Fernando, "Percentage-Closer Soft
// Shadows", 2005). 0 where there are none.
float sun_penumbra_m(vec3 point, vec3 normal, vec3 towards_sun)
{
    const uint count = 48u;
    SunPlace place = sun_place(point, normal, towards_sun, 0.0);
    float reach_m = max(1.0 - place.depth, 0.0) * sun_shadow.depth_m * sun_shadow.sun_slope;
    float sum = 0.0;
    float found = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 aside_m = reach_m * spiral(i, count, 0.6);
        vec2 aside = aside_m * sun_shadow.texels_per_m;
        float plane = place.depth + dot(aside, place.gradient);
        float blocker = sun_depth_at(ivec2(round(place.texel + aside)));
        float above_m = (blocker - plane) * sun_shadow.depth_m;
        bool blocks = blocker > max(plane, 0.0) + place.bias &&
                      length(aside_m) <= above_m * sun_shadow.sun_slope + sun_shadow.texel_m;
        sum += blocks ? above_m : 0.0;
        found += blocks ? 1.0 : 0.0;
    }
    return found > 0.0 ? sum / found * sun_shadow.sun_slope : 0.0;
}

// Share of light that a disc of `radius_m`, square to the sun, lets through to a point.
float sun_soft_visibility(vec3 point, vec3 normal, vec3 towards_sun, float radius_m)
{
    const uint count = 48u;
    SunPlace place = sun_place(point, normal, towards_sun, 0.0);
    float sum = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 aside = radius_m * spiral(i, count, 0.5) * sun_shadow.texels_per_m;
        sum += sun_compare(place.texel + aside, place.depth + dot(aside, place.gradient), place.gradient,
                           place.bias);
    }
    return sum / float(count);
}

#endif
