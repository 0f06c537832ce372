// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_REST
#define ESTAMPE_CLOTH_REST

// A sheet comes to rest if all its particles have been calm for a while and nothing moves around the sheet.
//
// Requires everything that cloth_flow.glsl requires.

#include "techniques/cloth/air/cloth_flow.glsl"

// Whether a solid that moves during the run of steps comes near a place.
bool is_neared(vec3 place)
{
    bool is_near = false;
    for (uint i = 0u; i < (run.collider_stride == 0u ? 0u : run.collider_count); ++i) {
        int before = 3 * int(i);
        int after = before + 3 * int(run.collider_stride);
        uvec4 there[2] = uvec4[2](texelFetch(collider_texels, before), texelFetch(collider_texels, after));
        bool moves = there[0] != there[1] ||
                     texelFetch(collider_texels, before + 1) != texelFetch(collider_texels, after + 1) ||
                     texelFetch(collider_texels, before + 2) != texelFetch(collider_texels, after + 2);
        moves =
            moves || (run.bodies_move != 0u && (there[1].w & ((1u << cloth_kind_bits) - 1u)) == cloth_seen);
        vec3 from = uintBitsToFloat(there[0].xyz);
        vec3 way = uintBitsToFloat(there[1].xyz) - from;
        float nearest = clamp(dot(place - from, way) / max(dot(way, way), 1e-20), 0.0, 1.0);
        float reach_m = max(uintBitsToFloat(texelFetch(collider_texels, before + 2).w),
                            uintBitsToFloat(texelFetch(collider_texels, after + 2).w));
        const float spare_m = 0.01;
        bool reaches = distance(place, from + nearest * way) <= reach_m + sheet.thickness_m + spare_m;
        is_near = is_near || (moves && reaches);
    }
    return is_near;
}

// Whether a holder, air or a solid moves a particle, or is about to move it.
bool is_roused(uint local, vec3 place, uint step)
{
    vec4 before = texelFetch(target_before_texels, int(sheet.first + local));
    vec4 after = texelFetch(target_after_texels, int(sheet.first + local));
    bool is_led = after.w > 0.0 && before.xyz != after.xyz;
    bool is_blown =
        (variant & cloth_bit_flow) != 0u && length(in_flows(place, vec3(0.0))) > cloth_breath_m_per_s;
    return step < run.roused_steps || is_led || is_blown || is_neared(place);
}

#endif
