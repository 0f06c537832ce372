// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_FLOW
#define ESTAMPE_CLOTH_FLOW

// Velocity of air from fluid simulations, in boxes.
//
// Requires: uniform samplerBuffer flow_texels, the velocities in the middle of cells, one box after another.

#include "techniques/cloth/cloth_data.glsl"

vec3 flow_speed(uint first, ivec3 cells, vec3 at)
{
    vec3 from_middle = clamp(at - 0.5, vec3(0.0), vec3(cells - 1));
    ivec3 low = min(ivec3(from_middle), cells - 2);
    vec3 share = from_middle - vec3(low);
    vec3 speed = vec3(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
        ivec3 cell = low + corner;
        vec3 own = mix(1.0 - share, share, vec3(corner));
        int texel = int(first) + (cell.z * cells.y + cell.y) * cells.x + cell.x;
        speed += own.x * own.y * own.z * texelFetch(flow_texels, texel).xyz;
    }
    return speed;
}

// Air velocity at a place. `outside` is the velocity beyond the boxes. At a box's border, both velocities are
// blended over two cells.
vec3 in_flows(vec3 place, vec3 outside)
{
    vec3 speed = outside;
    for (uint i = 0u; i < run.flow_count; ++i) {
        vec3 at = (run.flows[i].cells_from_place * vec4(place, 1.0)).xyz;
        vec3 cells = vec3(run.flows[i].cells);
        vec3 within = min(at, cells - at);
        float share = clamp(0.5 * min(within.x, min(within.y, within.z)), 0.0, 1.0);
        if (share > 0.0) {
            speed = mix(speed, flow_speed(run.flows[i].first, ivec3(cells), at), share);
        }
    }
    return speed;
}

#endif
