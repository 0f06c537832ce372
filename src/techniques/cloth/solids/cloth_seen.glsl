// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SEEN
#define ESTAMPE_CLOTH_SEEN

// A solid of cloth_solids.glsl: a body between its front and back surfaces. Texels give the body's middle
// along z, half its thickness, and the distance of a place inside the outline in x and y. Zanuttini,
// "Recherches en rendu non réaliste temps réel", Université Paris 8, 2008, section 7.5.

#include "techniques/cloth/cloth_data.glsl"

// The body that is being tested: its first texel, half its size at the beginning of the run of steps, and the
// time as a share of the run.
int body_first = 0;
vec3 body_half_before_m = vec3(0.0);
float body_part = 0.0;

void look_at_body(int first, vec3 half_before_m, float part)
{
    body_first = first;
    body_half_before_m = half_before_m;
    body_part = part;
}

// Surface of a body at a place in x and y: interpolated values, with their slopes.
struct Seen {
    vec3 middle_m;
    vec3 thick_m;  // half the body's thickness along z (value and slopes)
    vec3 within_m; // distance inside the body's outline (value and slopes); unlimited far inside
    float texel_m;
    bool is_near; // if false, the place is too far from the outline to know the body's middle
};

vec3 seen_texel(bool is_after, int at)
{
    return uintBitsToFloat(is_after ? texelFetch(seen_after_texels, at).xyz
                                    : texelFetch(seen_before_texels, at).xyz);
}

vec3 value_and_slope(vec4 corners, vec2 f, vec2 texel_m)
{
    vec2 low_high = mix(corners.xz, corners.yw, f.x);
    vec2 rise = vec2(mix(corners.y - corners.x, corners.w - corners.z, f.y), low_high.y - low_high.x);
    return vec3(mix(low_high.x, low_high.y, f.y), rise / texel_m);
}

Seen seen_then(bool is_after, vec2 half_m, vec2 place)
{
    ivec2 nodes = ivec2(seen_texel(is_after, body_first).xy);
    vec2 texel_m = 2.0 * half_m / vec2(nodes - 1);
    vec2 at = clamp(0.5 + 0.5 * place / half_m, vec2(0.0), vec2(1.0)) * vec2(nodes - 1);
    ivec2 low = min(ivec2(at), nodes - 2);
    int corner = body_first + int(cloth_seen_head) + low.y * nodes.x + low.x;
    vec4 numbers[3]; // the three values of a texel at the four corners of a cell
    float sum_m = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 texel = seen_texel(is_after, corner + (i >> 1) * nodes.x + (i & 1));
        bool is_near = texel.z > -cloth_seen_nowhere_m;
        numbers[0][i] = texel.x;
        numbers[1][i] = texel.y;
        numbers[2][i] = texel.z;
        sum_m += is_near ? texel.x : 0.0;
        count += is_near ? 1.0 : 0.0;
    }
    for (int i = 0; i < 4; ++i) {
        numbers[0][i] = numbers[2][i] > -cloth_seen_nowhere_m ? numbers[0][i] : sum_m / max(count, 1.0);
    }
    vec2 f = at - vec2(low);
    return Seen(value_and_slope(numbers[0], f, texel_m), value_and_slope(numbers[1], f, texel_m),
                value_and_slope(numbers[2], f, texel_m), min(texel_m.x, texel_m.y), count > 0.0);
}

// Interpolated surface at the beginning and the end of the run of steps. If a body's middle is unknown at one
// of the two times, the middle at the other time is used for both.
Seen[2] seen_twice(vec2 half_m, vec2 place)
{
    Seen before = seen_then(false, body_half_before_m.xy, place);
    Seen after = seen_then(true, half_m, place);
    before.middle_m = before.is_near ? before.middle_m : after.middle_m;
    after.middle_m = after.is_near ? after.middle_m : before.middle_m;
    return Seen[2](before, after);
}

vec4 seen_at(vec3 half_m, vec3 place)
{
    Seen seen[2] = seen_twice(half_m.xy, place.xy);
    float most_m = 2.0 * seen[1].texel_m; // distances from the outline beyond this limit are unknown
    if (!seen[0].is_near && !seen[1].is_near) {
        return vec4(0.0, 1.0, 0.0, most_m);
    }
    vec3 middle_m = seen[0].middle_m + body_part * (seen[1].middle_m - seen[0].middle_m);
    vec3 thick_m = seen[0].thick_m + body_part * (seen[1].thick_m - seen[0].thick_m);
    vec3 within_m = seen[0].within_m + body_part * (seen[1].within_m - seen[0].within_m);
    float side = place.z < middle_m.x ? -1.0 : 1.0;
    vec3 slope = vec3(-side * middle_m.yz - thick_m.yz, side);
    float steepness = length(slope);
    vec3 along_z = slope / steepness;
    float above_m = (side * (place.z - middle_m.x) - thick_m.x) / steepness;
    float narrowing = length(within_m.yz);
    vec3 aside = narrowing > 1e-6 ? vec3(-within_m.yz / narrowing, 0.0) : along_z;
    float beside_m = -within_m.x;
    if (min(above_m, beside_m) > 0.0) {
        vec3 way = beside_m * aside + above_m * along_z;
        return vec4(normalize(way), min(length(vec2(beside_m, above_m)), most_m));
    }
    return beside_m > above_m ? vec4(aside, min(beside_m, most_m)) : vec4(along_z, min(above_m, most_m));
}

// Motion along z of the body's front or back surface, whichever is nearer to the place, between two times of
// a run.
float surface_way_m(vec3 half_m, vec3 place, float begin, float end)
{
    Seen seen[2] = seen_twice(half_m.xy, place.xy);
    float middle_way_m = seen[1].middle_m.x - seen[0].middle_m.x;
    float side = place.z < seen[0].middle_m.x + begin * middle_way_m ? -1.0 : 1.0;
    return (end - begin) * (middle_way_m + side * (seen[1].thick_m.x - seen[0].thick_m.x));
}

#endif
