// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_SELF
#define ESTAMPE_CLOTH_SELF

// How a sheet keeps from itself: from the nearest four of those that are not near at rest, a particle goes
// half of what is missing.
//
// Wanted before: vec4 predicted_at(uint local), uvec4 near_of(uint local).

#include "techniques/cloth/cloth_data.glsl"

vec3 kept_from_self(uint local, vec3 place)
{
    uvec4 others = near_of(local);
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        bool is_there = others[i] != cloth_no_vertex;
        vec3 off = place - predicted_at(is_there ? others[i] : local).xyz;
        float away_m = length(off);
        if (is_there && away_m > 1e-9 && away_m < sheet.self_m) {
            sum += off * (0.5 * (sheet.self_m - away_m) / away_m);
            count += 1.0;
        }
    }
    return place + sum / max(count, 1.0);
}

#endif
