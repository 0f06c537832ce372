// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUN_SHADOW
#define ESTAMPE_SUN_SHADOW

// Looks the sun up in its map. Who includes this declares `SunShadow sun_shadow`, a uniform, and the map,
// `uint sun_map[]`, bits of reversed depth row by row.

#include "techniques/shadow/sun.glsl.h"

float sun_depth_at(ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), ivec2(sun_shadow.size) - 1);
    return uintBitsToFloat(sun_map[uint(inside.y) * sun_shadow.size + uint(inside.x)]);
}

// Share of the sun that arrives: four comparisons, blended as a bilinear lookup would (Reeves et al. 1987).
float sun_visibility(vec3 point, vec3 normal, vec3 towards_sun)
{
    float slope = sqrt(max(0.0, 1.0 - pow(dot(normal, towards_sun), 2.0)));
    vec3 lifted = point + normal * (sun_shadow.texel_m * (0.4 + 1.8 * slope));
    vec4 clip = sun_shadow.clip_from_anchor * vec4(lifted, 1.0);
    vec2 texel = (0.5 * clip.xy + 0.5) * float(sun_shadow.size) - 0.5;
    if (any(lessThan(texel, vec2(0.0))) || any(greaterThan(texel, vec2(sun_shadow.size - 1u)))) {
        return 1.0;
    }
    ivec2 corner = ivec2(floor(texel));
    vec2 f = texel - vec2(corner);
    // What lies beyond the farthest caster is as far as it; texels that no caster covers hold zero.
    float receiver = max(clip.z, 0.0) + sun_shadow.texel_m / sun_shadow.depth_m;
    vec4 blocker = vec4(sun_depth_at(corner), sun_depth_at(corner + ivec2(1, 0)),
                        sun_depth_at(corner + ivec2(0, 1)), sun_depth_at(corner + ivec2(1, 1)));
    vec4 lit = vec4(greaterThanEqual(vec4(receiver), blocker));
    return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

#endif
