// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_TETHERS
#define ESTAMPE_CLOTH_TETHERS

// Bending stiffness on a grid, and tethers (limits of the distance to held particles).
//
// Requires: vec4 predicted_at(uint local), with a position in xyz, and everything that cloth_torn.glsl
// requires.

#extension GL_EXT_control_flow_attributes : require

#include "techniques/cloth/solver/cloth_torn.glsl"

// For five neighbouring places in a row of a grid, centred on `at`: 1 if a particle exists there, else 0.
float[5] there_about(int at, int size)
{
    float there[5];
    [[unroll]] for (int i = 0; i < 5; ++i)
    {
        there[i] = uint(at + i - 2) < uint(size) ? 1.0 : 0.0;
    }
    return there;
}

// Bending of a grid as a thin plate in finite differences, without the differences that reach beyond the
// edge. Returns the coefficient of the vector to the particle x columns and y rows away, in the bending force
// at rigidity 1. Adding the terms of the bending force one by one needs fewer registers than adding all terms
// together.
float grid_bend_share(int x, int y, float columns[5], float rows[5])
{
    vec2 spacing = vec2(sheet.spacing_x_m, sheet.spacing_y_m);
    float twist = 2.0 / (spacing.x * spacing.y);
    if (x != 0 && y != 0) {
        return abs(x) == 1 && abs(y) == 1 ? -twist * columns[2 + x] * rows[2 + y] : 0.0;
    }
    int way = x + y;
    float along[5] = y == 0 ? columns : rows;
    float across[5] = y == 0 ? rows : columns;
    float by_side = y == 0 ? spacing.y / (spacing.x * spacing.x * spacing.x)
                           : spacing.x / (spacing.y * spacing.y * spacing.y);
    if (abs(way) == 2) {
        return -by_side * along[2 + way];
    }
    return 2.0 * by_side * (along[1] * along[3] + along[2 + 2 * way]) +
           twist * along[2 + way] * (across[1] + across[3]);
}

// Coefficient of the bending force like grid_bend_share(), for a sheet that may tear: particles behind a tear
// are omitted like particles beyond the edge.
float torn_bend_share(int x, int y, float columns[5], float rows[5], uvec2 torn)
{
    vec2 spacing = vec2(sheet.spacing_x_m, sheet.spacing_y_m);
    float twist = 2.0 / (spacing.x * spacing.y);
    if (x != 0 && y != 0) {
        bool is_cell = abs(x) == 1 && abs(y) == 1;
        return is_cell ? -twist * columns[2 + x] * rows[2 + y] * whole_cell(torn, x, y) : 0.0;
    }
    int way = x + y;
    float along[5] = y == 0 ? columns : rows;
    float across[5] = y == 0 ? rows : columns;
    float by_side = y == 0 ? spacing.y / (spacing.x * spacing.x * spacing.x)
                           : spacing.x / (spacing.y * spacing.y * spacing.y);
    if (abs(way) == 2) {
        return -by_side * along[2 + way] * whole_link(torn, x, y);
    }
    float here = along[1] * along[3] * whole_link(torn, x, y) * whole_link(torn, -x, -y);
    float there = along[2 + 2 * way] * whole_link(torn, 2 * x, 2 * y);
    float cells = across[1] * (y == 0 ? whole_cell(torn, x, -1) : whole_cell(torn, -1, y)) +
                  across[3] * (y == 0 ? whole_cell(torn, x, 1) : whole_cell(torn, 1, y));
    return 2.0 * by_side * (here + there) + twist * along[2 + way] * cells;
}

// Bending coefficient of a link in a sheet with lists. The bending force is a sum over hinges (two triangles
// at an edge). Next to a tear the bending force is omitted, because an incomplete hinge would add energy.
float torn_bending(float bending, uvec2 torn, uint other)
{
    return may_tear && (torn != uvec2(0u) || torn_of(other) != uvec2(0u)) ? 0.0 : bending;
}

// Coefficient of the particle's own position in the bending force.
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

// Limits the distance from held particles to the distance along the sheet: Kim, Chentanez and Müller, "Long
// Range Attachments", SCA 2012.
vec3 tethered(uint local, vec3 place)
{
    uint k = 0u;
    do { // tests at the end: otherwise CPU implementations of Vulkan run one extra round
        if (k < sheet.tether_width) {
            uvec2 tether = texelFetch(tether_texels, int(sheet.first_tether + k * sheet.stride + local)).xy;
            vec3 held = predicted_at(tether.x).xyz;
            float length_m = distance(place, held);
            float most_m = uintBitsToFloat(tether.y);
            if (length_m > most_m) {
                place = held + (place - held) * (most_m / length_m);
            }
        }
        ++k;
    } while (k < sheet.tether_width);
    return place;
}

#endif
