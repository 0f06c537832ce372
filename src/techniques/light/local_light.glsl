// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOCAL_LIGHT
#define ESTAMPE_LOCAL_LIGHT

// Reach and attenuation of local lights (lamps and spots).

#include "techniques/light/light.glsl.h"

// Share of a spot's light that leaves along the unit vector `beam`; 1 for lamps.
float in_cone(LightRecord light, vec3 beam)
{
    uint type = light.type & light_type_mask;
    float cosine = dot(beam, light.direction);
    if (type == light_pyramid) {
        float aside = max(abs(dot(beam, light.side)), abs(dot(beam, cross(light.side, light.direction))));
        cosine *= inversesqrt(max(cosine * cosine + aside * aside, 1e-12));
    }
    float cone = clamp(cosine * light.cone_scale + light.cone_offset, 0.0, 1.0);
    return type >= light_spot ? cone * cone : 1.0;
}

// Attenuation of a local light with distance: the windowed inverse square of KHR_lights_punctual, or the
// falloff of a unit volume.
float weakened(LightRecord light, float distance_2)
{
    float ratio = distance_2 / (light.range_m * light.range_m);
    float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    return (light.type & light_unit_volume) != 0u ? clamp(1.0 - ratio, 0.0, 1.0) : window / distance_2;
}

// Bounding sphere of the space that a local light reaches: about the light, or tighter about a narrow spot's
// cone.
vec4 reach_of(LightRecord light)
{
    uint type = light.type & light_type_mask;
    float r = light.range_m;
    float cosine = -light.cone_offset / max(light.cone_scale, 1e-6);
    if (type == light_pyramid) {
        // The corners of a spot's pyramid lie farther out than the pyramid's sides, so the bounding cone is
        // wider.
        cosine = cosine > 0.0 ? inversesqrt(max(2.0 / (cosine * cosine) - 1.0, 1.0)) : 0.0;
    }
    if (type < light_spot || cosine <= 0.0) {
        return vec4(light.position, r);
    }
    bool is_narrow = cosine > 0.70710678;
    float along = is_narrow ? 0.5 * r / cosine : r * cosine;
    float radius = is_narrow ? along : r * sqrt(max(1.0 - cosine * cosine, 0.0));
    return vec4(light.position + light.direction * along, radius);
}

#endif
