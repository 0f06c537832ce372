// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_MET
#define ESTAMPE_CLOTH_MET

// Finds the solids near a group of cloth particles, once for all small steps of a step, so that distant
// solids cost little.

#include "techniques/cloth/cloth_data.glsl"
#include "techniques/cloth/solids/cloth_solids.glsl"

// Number of words in the record of a workgroup: its bounding ball, and the bits of nearby solids.
uint met_stride()
{
    return cloth_met_head + min((run.collider_count + 31u) / 32u, cloth_met_words);
}

// Distance that a particle will hardly move beyond in a step.
float hardly_beyond_m(vec3 speed, vec3 push)
{
    const float spare_m = 2e-3;
    return spare_m + 1.1 * run.step_s * (length(speed) + run.step_s * length(push));
}

// Lower bound of the distance from a place to a simple solid, in the solid's coordinates.
float least_away_m(uint kind, vec3 half_m, vec3 place)
{
    if (kind == cloth_ellipsoid) {
        return (length(place / half_m) - 1.0) * min(half_m.x, min(half_m.y, half_m.z));
    }
    return solid_at(kind, half_m, place).w;
}

// Whether a solid comes near a ball at any time of a step. A moving solid, a distance grid or a body is
// bounded by a sphere about the solid's centre; for height grids, and for simple solids that stand still, the
// distance is computed. Height grids do not move.
bool comes_near(uint i, vec4 ball, uint step)
{
    int before = 3 * int(i);
    int after = before + 3 * int(run.collider_stride);
    vec3 centre_before = uintBitsToFloat(texelFetch(collider_texels, before).xyz);
    vec3 centre_way = uintBitsToFloat(texelFetch(collider_texels, after).xyz) - centre_before;
    float reach_m = uintBitsToFloat(texelFetch(collider_texels, after + 2).w);
    vec3 from = centre_before + part_of_run(step, 0.0) * centre_way;
    vec3 way = centre_before + part_of_run(step + 1u, 0.0) * centre_way - from;
    float nearest = clamp(dot(ball.xyz - from, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
    float away_m = distance(ball.xyz, from + nearest * way);
    const float rounding = 1e-5;
    float near_m = sheet.thickness_m + ball.w + 1e-3;
    bool is_in_reach = away_m * (1.0 - rounding) <= reach_m + near_m;
    uint kind_and_grid = texelFetch(collider_texels, after).w;
    uint kind = kind_and_grid & ((1u << cloth_kind_bits) - 1u);
    bool is_heights = (variant & cloth_bit_grids) != 0u && kind == cloth_heights;
    bool is_simple = run.collider_stride == 0u && kind < cloth_heights;
    if (!is_in_reach || !(is_heights || is_simple)) {
        return is_in_reach;
    }
    vec4 rotation = uintBitsToFloat(texelFetch(collider_texels, after + 1));
    vec3 half_m = uintBitsToFloat(texelFetch(collider_texels, after + 2).xyz);
    vec3 place = turned_back(rotation, ball.xyz - from);
    float spare_m = 1e-3 + rounding * length(place);
    if (is_heights) {
        int first = int(kind_and_grid >> cloth_kind_bits);
        return !are_far_below(first, half_m, vec4(place, ball.w + spare_m), sheet.thickness_m + spare_m);
    }
    return least_away_m(kind, half_m, place) <= near_m + rounding * length(place);
}

// For 32 solids, one bit each that tells whether the solid comes near the ball.
uint solids_near(uint word, vec4 ball, uint step)
{
    uint near = 0u;
    uint first = 32u * word;
    uint count = run.collider_count > first ? min(run.collider_count - first, 32u) : 0u;
    for (uint i = 0u; i < count; ++i) {
        near |= comes_near(first + i, ball, step) ? 1u << i : 0u;
    }
    return near;
}

#endif
