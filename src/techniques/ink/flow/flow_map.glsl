// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FLOW_MAP
#define ESTAMPE_INK_FLOW_MAP

// The stream function of a flow map (picture of velocities), whose nodes are spread over the page. Requires
// before inclusion: flow.glsl, `globals`, `map_texels`.

#include "techniques/ink/flow/spline.glsl"

float flow_map_stream(vec2 place_mm)
{
    vec2 last = vec2(float(ink_map_side - 1u));
    vec2 at = clamp(place_mm / globals.page_mm * last, vec2(0.0f), last);
    vec2 node = floor(at + 0.5f);
    vec3 across = spline_values(at.x - node.x);
    vec3 down = spline_values(at.y - node.y);
    float psi = 0.0f;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            ivec2 from = clamp(ivec2(node) + ivec2(column, row) - 1, ivec2(0), ivec2(int(ink_map_side) - 1));
            psi += across[column] * down[row] * texelFetch(map_texels, from.y * int(ink_map_side) + from.x).x;
        }
    }
    return globals.map_mm_per_s * psi;
}

#endif
