// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LOCAL_SHADOW
#define ESTAMPE_LOCAL_SHADOW

// Looks up a local light's shadow maps. The including shader declares `LocalShadow local_shadows[]` and the
// texels of all maps, `samplerBuffer local_maps`.

#include "shaders/sun_disc.glsl"
#include "techniques/shadow/shadow.glsl.h"

// The position of a point in a local shadow map.
struct MapPlace {
    vec3 right; // axes of the shadow map: right and down
    vec3 down;
    vec2 texel;    // position in texels; texel centres are at whole numbers
    float along_m; // distance of the point from the light along the map's axis
    uint first_texel;
};

// Finds the map that covers the direction `from_light`, and the point's position in the found map.
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

// Size of a shadow map texel at distance 1 from the light.
float texel_width(LocalShadow shadow)
{
    return 2.0 / (shadow.scale * float(shadow.size));
}

float local_depth_at(LocalShadow shadow, uint first_texel, ivec2 texel)
{
    ivec2 inside = clamp(texel, ivec2(0), ivec2(shadow.size) - 1);
    return texelFetch(local_maps, int(first_texel + uint(inside.y) * shadow.size + uint(inside.x))).x;
}

// Distance by which a point is lifted along its normal before a shadow map lookup, so that its own surface
// does not shadow it. All texels of a lookup are at most one texel away from the point in either direction.
// Within one texel in both directions, the depth of the surface's plane changes; most of the lift compensates
// the largest change. The rest of the lift allows for rounding and smoothed normals.
float lift_m(MapPlace place, LocalShadow shadow, vec3 normal)
{
    float texel_m = texel_width(shadow) * max(place.along_m, 0.0);
    return texel_m * (0.3 + 1.25 * (abs(dot(normal, place.right)) + abs(dot(normal, place.down))));
}

// Share of light at a place in a shadow map: four depth comparisons, blended bilinearly (Reeves et al. 1987).
// 1 outside the map.
float compare_at(LocalShadow shadow, MapPlace place)
{
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

// Position in the shadow map of a point that is lifted off its surface. The lift goes towards the light, so
// that texel and shadow stay in place, but at most a fifth of the way to the light. The rest of the lift goes
// along the normal.
MapPlace lifted_place(LocalShadow shadow, vec3 from_light, vec3 normal)
{
    float lift = lift_m(map_place(shadow, from_light), shadow, normal);
    float height_m = max(-dot(normal, from_light), 1e-9);
    float on_the_way_m = min(lift, 0.2 * height_m);
    MapPlace place = map_place(shadow, from_light + normal * (lift - on_the_way_m));
    place.along_m *= 1.0 - on_the_way_m / height_m;
    return place;
}

// Share of a point light at `light_position` that arrives at a point of anchor space (relative to a nearby
// origin).
float local_visibility(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal)
{
    return compare_at(shadow, lifted_place(shadow, point - light_position, normal));
}

// A disc around a point in shadow lookups, perpendicular to the light's direction. A tap (one texel read)
// compares the texel's depth with the surface's plane, but never farther from the light than the disc. An
// object behind the disc cannot block the light.
struct LampDisc {
    vec3 from_light;
    vec3 right;
    vec3 down;
    vec3 normal;
};

LampDisc lamp_disc(vec3 from_light, vec3 normal)
{
    vec3 along = normalize(from_light);
    vec3 right = normalize(abs(along.y) < 0.9 ? vec3(along.z, 0.0, -along.x) : vec3(0.0, along.z, -along.y));
    return LampDisc(from_light, right, cross(along, right), normal);
}

// Factor by which the surface's plane is nearer to the light than the disc, at the place `on_disc`.
float nearer_by(LampDisc disc, vec3 on_disc)
{
    float height = min(dot(disc.normal, disc.from_light), -1e-9);
    return height / min(dot(disc.normal, on_disc), height);
}

// Result of one texel read. First: the distance of the blocker as a share of the distance from light to disc.
// Second: whether the blocker is in front of the surface's plane.
struct Blocker {
    float share;
    bool blocks;
};

// Reads the blocker at the place `aside` on the disc. The texel read is the nearest to a place `shift` texels
// beside `aside`.
Blocker blocker_at(LocalShadow shadow, LampDisc disc, vec2 aside, vec2 shift)
{
    vec3 on_disc = disc.from_light + disc.right * aside.x + disc.down * aside.y;
    float factor = nearer_by(disc, on_disc);
    vec3 receiver = on_disc * factor;
    MapPlace place = map_place(shadow, receiver);
    vec2 texel = floor(place.texel + shift + 0.5);
    bool inside = place.along_m > shadow.near_m && all(greaterThanEqual(texel, vec2(0.0))) &&
                  all(lessThan(texel, vec2(shadow.size)));
    float depth = local_depth_at(shadow, place.first_texel, ivec2(texel));
    float blocker_m = shadow.near_m / max(depth, 1e-9);
    // The point is lifted towards the light, as in lifted_place().
    float height_m = max(-dot(disc.normal, receiver), max(-dot(disc.normal, disc.from_light), 1e-9));
    float lifted_m = place.along_m * (1.0 - lift_m(place, shadow, disc.normal) / height_m);
    return Blocker(clamp(blocker_m / max(place.along_m, 1e-9) * factor, 1e-6, 0.99999),
                   inside && depth > 0.0 && blocker_m < lifted_m * (1.0 - 0.5 * texel_width(shadow)));
}

// Half widths in metres of penumbrae (soft shadow edges) that contain the point or are next to it; 0 if there
// are no penumbrae.
struct Penumbra {
    float mean_m;
    float widest_m;
};

// Estimates the penumbra at a point: searches for blockers of some part of the light (Fernando,
// "Percentage-Closer Soft Shadows", 2005). Misses blockers whose distance from the light's centre is less
// than twice the light's radius.
Penumbra local_penumbra(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal)
{
    const uint most_taps = 40u;
    LampDisc disc = lamp_disc(point - light_position, normal);
    float distance_m = length(disc.from_light);
    float reach_m = max(0.5 * distance_m - shadow.radius_m, 0.0);
    float texel_m = texel_width(shadow) * distance_m;
    uint count = shadow.radius_m > 0.0 ? most_taps : 0u;
    float sum = 0.0;
    float found = 0.0;
    float widest_m = 0.0;
    for (uint i = 0u; i < count; ++i) {
        // Texel reads are dense around the centre, where far blockers appear.
        vec2 aside = reach_m * spiral(i, most_taps, 4.0);
        Blocker blocker = blocker_at(shadow, disc, aside, vec2(0.0));
        float half_breadth_m = shadow.radius_m * (1.0 / blocker.share - 1.0);
        bool counts = blocker.blocks && length(aside) <= half_breadth_m + texel_m;
        sum += counts ? half_breadth_m : 0.0;
        found += counts ? 1.0 : 0.0;
        // Blockers a bit farther out also count, because the search may have missed parts between two reads.
        bool is_near = blocker.blocks && length(aside) <= 2.0 * half_breadth_m + texel_m;
        widest_m = is_near ? max(widest_m, half_breadth_m) : widest_m;
    }
    return Penumbra(sum / max(found, 1.0), widest_m);
}

// Bit mask of the light's rings within a radius. All rings have equal area; radius 1 is the light's own
// radius.
uint rings_within(float radius)
{
    uint count = uint(32.0 * min(radius * radius, 1.0) + 0.5);
    return count >= 32u ? ~0u : (1u << count) - 1u;
}

const uint lamp_directions = 24u;

// Rings of a light that are hidden along one direction from its centre. A blocker at share s of the distance,
// seen through a place on the disc, hides the opposite side of the light, at s / (1 - s) times the place's
// distance from the centre. A continuous blocker between two places hides everything between the two hidden
// points of the light. After Guennebaud, Barthe and Paulin, "Real-Time Soft Shadow Mapping by
// Backprojection", 2006; bit masks after Schwarz and Stamminger, "Bitmask Soft Shadows", 2007.
uint hidden_rings(LocalShadow shadow, LampDisc disc, float radius_m, float widest_m, uint direction)
{
    const uint count = 6u;
    float k = float(direction);
    float angle = 6.2831853 / float(lamp_directions) * (k + 0.5);
    vec2 way = vec2(cos(angle), sin(angle));
    // Each direction gets its own offsets of the read places and texels.
    float first = fract(0.61803399 * k);
    vec2 shift = fract(k * vec2(0.7548777, 0.5698403)) - 0.5;
    float inner_m = 0.0;
    float last = 0.0;
    bool blocked = false;
    uint rings = 0u;
    for (uint i = 0u; i < count; ++i) {
        vec2 part = (vec2(float(i), float(i) + 0.5) + first) / float(count);
        vec2 away_m = widest_m * part * sqrt(part);
        Blocker blocker = blocker_at(shadow, disc, way * away_m.x, shift);
        // The height of the edge where a blocker starts is uncertain by a texel.
        float height = 1.0 - blocker.share;
        float least_height = max(height - texel_width(shadow), 1e-6);
        float inner = blocker.share * inner_m / (least_height * radius_m);
        float outer = max(blocker.share * away_m.y / (height * radius_m), inner);
        uint hidden = rings_within(blocked ? max(outer, last) : outer) &
                      ~rings_within(blocked ? min(inner, last) : inner);
        rings |= blocker.blocks ? hidden : 0u;
        blocked = blocker.blocks;
        last = outer;
        inner_m = away_m.y;
    }
    return rings;
}

// Share of a spherical light of `radius_m` that arrives at a point; `widest_m` is the half width of penumbrae
// on the disc.
float local_soft_visibility(LocalShadow shadow, vec3 light_position, vec3 point, vec3 normal, float radius_m,
                            float widest_m)
{
    LampDisc disc = lamp_disc(point - light_position, normal);
    // The reach has a margin, because the search may have missed the widest penumbra. The reach is at least
    // one texel.
    float reach_m = max(1.1 * widest_m, texel_width(shadow) * length(disc.from_light));
    uint directions = widest_m > 0.0 ? lamp_directions : 0u;
    uint hidden = 0u;
    for (uint k = 0u; k < directions; ++k) {
        hidden += uint(bitCount(hidden_rings(shadow, disc, radius_m, reach_m, k)));
    }
    return directions > 0u ? 1.0 - float(hidden) / float(32u * lamp_directions)
                           : compare_at(shadow, lifted_place(shadow, disc.from_light, normal));
}

#endif
