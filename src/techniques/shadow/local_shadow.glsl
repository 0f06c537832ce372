// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOCAL_SHADOW
#define ESTAMPE_LOCAL_SHADOW

// Looks a local light up in its maps. Who includes this declares `LocalShadow local_shadows[]` and the texels
// of all maps, `samplerBuffer local_maps`.

#include "techniques/shadow/local.glsl.h"

// A point as a map sees it.
struct MapPlace {
    vec3 right; // axes of the map
    vec3 down;
    vec2 texel;    // centres of texels lie on whole numbers
    float along_m; // distance from the light along the map's axis
    uint first_texel;
};

// The map that looks `from_light`, and where it sees that point.
MapPlace map_place(LocalShadow shadow, vec3 from_light)
{
    MapPlace place;
    place.first_texel = shadow.first_texel;
    if (shadow.is_cube != 0u) {
        vec3 size = abs(from_light);
        bool x_first = size.x >= size.y && size.x >= size.z;
        bool y_first = !x_first && size.y >= size.z;
        float along = x_first ? from_light.x : y_first ? from_light.y : from_light.z;
        uint face = (x_first ? 0u : y_first ? 2u : 4u) + (along < 0.0 ? 1u : 0u);
        place.right = x_first ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
        place.down = y_first ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
        place.along_m = abs(along);
        place.first_texel += face * shadow.size * shadow.size;
    } else {
        place.right = shadow.right;
        place.down = shadow.down;
        place.along_m = dot(from_light, shadow.along);
    }
    vec2 side = vec2(dot(from_light, place.right), dot(from_light, place.down));
    place.texel = (0.5 * shadow.scale / max(place.along_m, 1e-9) * side + 0.5) * float(shadow.size) - 0.5;
    return place;
}

// Size of a texel at a distance of 1 from the light.
float texel_width(LocalShadow shadow)
{
    return 2.0 / (shadow.scale * float(shadow.size));
}

float local_depth_at(LocalShadow shadow, uint first_texel, ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), ivec2(shadow.size) - 1);
    return texelFetch(local_maps, int(first_texel + uint(inside.y) * shadow.size + uint(inside.x))).x;
}

// How far a receiver is lifted along its normal. All texels that a lookup compares with lie within one texel
// of it, in either direction; over them the distance of its own plane from the light, along the axis of the
// map, varies by just as much as a lift of texel * (|n.right| + |n.down|) makes up for. The rest is for
// rounding and for normals that are smoother than the surface.
float lift_m(MapPlace place, LocalShadow shadow, vec3 normal)
{
    float texel_m = texel_width(shadow) * max(place.along_m, 0.0);
    return texel_m * (0.3 + 1.25 * (abs(dot(normal, place.right)) + abs(dot(normal, place.down))));
}

// Share of a local light at `light_position` that arrives at a point of anchor space: four comparisons,
// blended as a bilinear lookup would (Reeves et al. 1987). 1 where the map does not look.
float local_visibility(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal)
{
    MapPlace place = map_place(shadow, point - light_position);
    vec3 lifted = point + normal * lift_m(place, shadow, normal);
    place = map_place(shadow, lifted - light_position);
    float last = float(shadow.size - 1u);
    if (place.along_m <= shadow.near_m || any(lessThan(place.texel, vec2(0.0))) ||
        any(greaterThan(place.texel, vec2(last)))) {
        return 1.0;
    }
    ivec2 corner = ivec2(floor(place.texel));
    vec2 f = place.texel - vec2(corner);
    float nearer_m = max(place.along_m * (1.0 - 0.5 * texel_width(shadow)), shadow.near_m);
    float receiver = shadow.near_m / nearer_m;
    vec4 blocker = vec4(local_depth_at(shadow, place.first_texel, corner),
                        local_depth_at(shadow, place.first_texel, corner + ivec2(1, 0)),
                        local_depth_at(shadow, place.first_texel, corner + ivec2(0, 1)),
                        local_depth_at(shadow, place.first_texel, corner + ivec2(1, 1)));
    vec4 lit = vec4(greaterThanEqual(vec4(receiver), blocker));
    return mix(mix(lit.x, lit.y, f.x), mix(lit.z, lit.w, f.x), f.y);
}

#endif
