// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_TETHERS
#define ESTAMPE_CLOTH_TETHERS

// What all solvers share: bending on a grid, and tethers.
//
// Wanted before: vec4 predicted_at(uint local), a place and whatever else.

#include "techniques/cloth/cloth_data.glsl"

const bool is_relaxing = (variant & cloth_bit_relax) != 0u;

// Force by bending of rigidity 1: that of a thin plate in finite differences, of which those are left out
// that reach beyond the edge.
vec3 grid_bend(vec3 towards[25], ivec2 at, ivec2 size)
{
    vec3 sum = vec3(0.0);
    vec2 spacing = vec2(sheet.spacing_x_m, sheet.spacing_y_m);
    [[unroll]] for (int axis = 0; axis < 2; ++axis)
    {
        int way = axis == 0 ? 1 : 5;
        vec3 along = vec3(0.0);
        if (at[axis] >= 1 && at[axis] + 1 < size[axis]) {
            along += 2.0 * (towards[12 - way] + towards[12 + way]);
        }
        if (at[axis] >= 2) {
            along -= towards[12 - 2 * way] - 2.0 * towards[12 - way];
        }
        if (at[axis] + 2 < size[axis]) {
            along -= towards[12 + 2 * way] - 2.0 * towards[12 + way];
        }
        sum += along * spacing[1 - axis] / (spacing[axis] * spacing[axis] * spacing[axis]);
    }
    vec3 twist = vec3(0.0);
    [[unroll]] for (int y = -1; y <= 1; y += 2)
    {
        [[unroll]] for (int x = -1; x <= 1; x += 2)
        {
            ivec2 corner = at + ivec2(x, y);
            if (all(greaterThanEqual(corner, ivec2(0))) && all(lessThan(corner, size))) {
                twist -= towards[12 + 5 * y + x] - towards[12 + 5 * y] - towards[12 + x];
            }
        }
    }
    return sum + twist * (2.0 / (spacing.x * spacing.y));
}

// By how much of that force a particle's own place takes part in it.
float grid_bend_own(ivec2 at, ivec2 size)
{
    vec2 spacing = vec2(sheet.spacing_x_m, sheet.spacing_y_m);
    float sum = 0.0;
    [[unroll]] for (int axis = 0; axis < 2; ++axis)
    {
        float along = at[axis] >= 1 && at[axis] + 1 < size[axis] ? 4.0 : 0.0;
        along += at[axis] >= 2 ? 1.0 : 0.0;
        along += at[axis] + 2 < size[axis] ? 1.0 : 0.0;
        sum += along * spacing[1 - axis] / (spacing[axis] * spacing[axis] * spacing[axis]);
    }
    vec2 sides = vec2(at.x >= 1 ? 1.0 : 0.0, at.y >= 1 ? 1.0 : 0.0) +
                 vec2(at.x + 1 < size.x ? 1.0 : 0.0, at.y + 1 < size.y ? 1.0 : 0.0);
    return sum + sides.x * sides.y * 2.0 / (spacing.x * spacing.y);
}

// No farther from particles that are held than the sheet reaches: Kim, Chentanez and Müller, "Long Range
// Attachments", SCA 2012.
vec3 tethered(uint local, vec3 place)
{
    for (uint k = 0u; k < (is_relaxing ? 0u : sheet.tether_width); ++k) {
        uvec2 tether = texelFetch(tether_texels, int(sheet.first_tether + k * sheet.stride + local)).xy;
        vec3 held = predicted_at(tether.x).xyz;
        float length_m = distance(place, held);
        float most_m = uintBitsToFloat(tether.y);
        if (length_m > most_m) {
            place = held + (place - held) * (most_m / length_m);
        }
    }
    return place;
}

#endif
