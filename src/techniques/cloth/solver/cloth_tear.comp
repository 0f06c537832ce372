// SPDX-License-Identifier: MIT
// One thread per particle, at the end of a step: finds the particle's links that tear in the step. Both ends
// of a link compute equal results, from equal positions of the two particles. The last of two passes removes
// the links that lead across a tear.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "techniques/cloth/cloth_data.glsl"

layout(binding = 12) uniform samplerBuffer place_texels;

layout(scalar, binding = 13) buffer Torn
{
    uvec2 torn_links[];
};

layout(scalar, binding = 14) readonly buffer Awake
{
    uint awake_in[];
};

layout(push_constant, scalar) uniform Constants
{
    ClothMoment moment;
};

uvec2 torn_of(uint local)
{
    return torn_links[sheet.first + local];
}

#include "techniques/cloth/solver/cloth_awake.glsl"
#include "techniques/cloth/solver/cloth_torn.glsl"

uvec2 bit_of(uint bit)
{
    return bit < 32u ? uvec2(1u << bit, 0u) : uvec2(0u, 1u << (bit - 32u));
}

bool is_too_long(uint local, uint other, float rest_m)
{
    vec3 from = texelFetch(place_texels, int(sheet.first + local)).xyz;
    vec3 to = texelFetch(place_texels, int(sheet.first + other)).xyz;
    return distance(from, to) > sheet.tear * rest_m;
}

bool is_within(ivec2 at)
{
    return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(sheet.columns, sheet.rows)));
}

uint local_at(ivec2 at)
{
    return uint(at.y) * sheet.columns + uint(at.x);
}

uvec2 near_torn_on_grid(uint local, ivec2 at)
{
    uvec2 torn = uvec2(0u);
    for (int i = 0; i < 9; ++i) {
        ivec2 way = ivec2(i % 3, i / 3) - 1;
        if (i == 4 || !is_within(at + way)) {
            continue;
        }
        float rest_m = length(vec2(way) * vec2(sheet.spacing_x_m, sheet.spacing_y_m));
        torn |= is_too_long(local, local_at(at + way), rest_m) ? bit_of(link_bit(way)) : uvec2(0u);
    }
    return torn;
}

bool is_torn(ivec2 at, ivec2 way)
{
    return has_bit(torn_of(local_at(at)), link_bit(way));
}

// Whether one of the two direct links of a path is torn. `first` is the path's first link.
bool is_torn_on_way(ivec2 at, ivec2 first, ivec2 second)
{
    return is_torn(at, first) || is_torn(at + first, second);
}

// Torn bits of far links on a grid. A link between particles two columns or rows apart tears when either
// direct link between the particles tears. A link a knight's move away tears when both paths along direct
// links are torn.
uvec2 far_torn_on_grid(ivec2 at)
{
    uvec2 torn = uvec2(0u);
    for (int i = 0; i < 25; ++i) {
        ivec2 way = ivec2(i % 5, i / 5) - 2;
        if (max(abs(way.x), abs(way.y)) < 2 || !is_within(at + way)) {
            continue;
        }
        ivec2 half_way = way / 2; // half of the link; for a knight's move, the straight part of the link
        ivec2 left = way - half_way;
        bool is_across = is_torn_on_way(at, half_way, left);
        if (half_way != left) {
            is_across = is_across && is_torn_on_way(at, left, half_way);
        }
        torn |= is_across ? bit_of(link_bit(way)) : uvec2(0u);
    }
    return torn;
}

uvec2 torn_cells(ivec2 at)
{
    uvec2 torn = uvec2(0u);
    for (int i = 0; i < 4; ++i) {
        ivec2 way = ivec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        if (!is_within(at + way)) {
            continue;
        }
        ivec2 x = ivec2(way.x, 0);
        ivec2 y = ivec2(0, way.y);
        bool is_any = is_torn_on_way(at, x, y) || is_torn_on_way(at, y, x) || is_torn(at, way) ||
                      is_torn(at + x, y - x);
        torn |= is_any ? bit_of(cell_bit(way)) : uvec2(0u);
    }
    return torn;
}

uvec2 near_torn_in_lists(uint local)
{
    uvec2 torn = uvec2(0u);
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 link = link_at(local, k);
        float rest_m = uintBitsToFloat(link.y);
        torn |= rest_m > 0.0 && is_too_long(local, link.x, rest_m) ? bit_of(k) : uvec2(0u);
    }
    return torn;
}

bool is_direct(uint local, uint other)
{
    bool is_found = false;
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 link = link_at(local, k);
        is_found = is_found || (link.x == other && uintBitsToFloat(link.y) > 0.0);
    }
    return is_found;
}

// Whether a tear lies between two particles: a common neighbour of both particles has a torn link to one of
// the two particles, or to another common neighbour.
bool is_across_in_lists(uint local, uint other)
{
    bool is_across = false;
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 link = link_at(local, k);
        if (!(uintBitsToFloat(link.y) > 0.0) || !is_direct(link.x, other)) {
            continue;
        }
        is_across = is_across || has_bit(torn_of(local), k) || is_torn_between(link.x, other);
        uvec2 torn = torn_of(link.x);
        for (uint i = 0u; i < (torn == uvec2(0u) ? 0u : sheet.link_width); ++i) {
            // Only direct links are tested, because cloth_tear.comp may have torn far links already.
            uvec4 next = link_at(link.x, i);
            bool is_beside = has_bit(torn, i) && uintBitsToFloat(next.y) > 0.0 && is_direct(next.x, local) &&
                             is_direct(next.x, other);
            is_across = is_across || is_beside;
        }
    }
    return is_across;
}

uvec2 far_torn_in_lists(uint local)
{
    uvec2 about = torn_of(local);
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 link = link_at(local, k);
        about |= uintBitsToFloat(link.y) > 0.0 ? torn_of(link.x) : uvec2(0u);
    }
    uvec2 torn = uvec2(0u);
    for (uint k = 0u; k < (about == uvec2(0u) ? 0u : sheet.link_width); ++k) {
        uvec4 link = link_at(local, k);
        bool is_gone = uintBitsToFloat(link.y) < 0.0 && is_across_in_lists(local, link.x);
        torn |= is_gone ? bit_of(k) : uvec2(0u);
    }
    return torn;
}

void main()
{
    uint group = moment.first_group + gl_WorkGroupID.x;
    uint sheet_index = sheet_of_group[2u * group];
    sheet = sheet_at(sheet_index);
    uint local = own_particle(sheet_of_group[2u * group + 1u]);
    if (local == cloth_no_vertex || !is_awake(sheet_index, moment.step)) {
        return;
    }
    bool is_last = (variant & cloth_bit_last) != 0u;
    uvec2 torn = uvec2(0u);
    if ((variant & cloth_bit_grid) != 0u) {
        ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
        torn = is_last ? far_torn_on_grid(at) | torn_cells(at) : near_torn_on_grid(local, at);
    } else {
        torn = is_last ? far_torn_in_lists(local) : near_torn_in_lists(local);
    }
    if (torn != uvec2(0u)) {
        torn_links[sheet.first + local] |= torn;
    }
}
