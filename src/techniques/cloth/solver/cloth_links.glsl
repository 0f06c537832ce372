// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_LINKS
#define ESTAMPE_CLOTH_LINKS

// Displacement of a particle by its links. Each link is solved separately. A particle's mass is shared among
// all its links; near links get a larger share. The results are added, which preserves momentum and is
// independent of the order. A link softer than the solver's limit is a spring with exactly its compliance.
// Macklin et al., "Small Steps in Physics Simulation", SCA 2019; Tonge et al., "Mass Splitting for
// Jitter-Free Parallel Rigid Body Simulation", SIGGRAPH 2012.
//
// Requires: vec4 predicted_at(uint local), a position and the inverse mass times the shares of the links
// there; vec4 predicted_beside(uint local, ivec2 way, bool is_there), the same values of another particle of
// the grid, if `is_there`; and everything that cloth_tethers.glsl requires.

#extension GL_EXT_control_flow_attributes : require

#include "techniques/cloth/solver/cloth_tethers.glsl"

// Over-relaxation of 4 / 3 lets no sheet and no thread oscillate. Grids allow more over-relaxation, because
// no wave moves all links of a grid at once.
const float over_relaxation = (variant & cloth_bit_grid) != 0u ? 1.6 : 4.0 / 3.0;

// Factor for the displacement of a particle by one link: the displacement is this factor times the vector to
// the link's far end, times the particle's inverse mass. `split_masses` is a sum over the link's two ends:
// inverse mass times the number of shares, as for a far link; `softness` is the compliance divided by the
// squared time step.
float link_pull(vec3 towards, float split_masses, float rest_m, bool is_far, float softness)
{
    float length_m = length(towards);
    float excess_m = length_m - rest_m;
    if (is_far) {
        excess_m = max(excess_m, 0.0) + min(length_m - sheet.fold * rest_m, 0.0);
    }
    float share = is_far ? 1.0 : cloth_near_share;
    float give = max(split_masses * (1.0 / (over_relaxation * share)), softness);
    return excess_m / (max(length_m, 1e-9) * give);
}

// Displacement by all links of a particle on a grid. The code has no branches: missing links have weight 0.
vec3 pull_of_grid(uint local, vec4 own, float inverse_mass, float time_s)
{
    ivec2 size = ivec2(sheet.columns, sheet.rows);
    ivec2 at = ivec2(local % sheet.columns, local / sheet.columns);
    float columns[5] = there_about(at.x, size.x);
    float rows[5] = there_about(at.y, size.y);
    float softness = sheet.softness / (time_s * time_s);
    float bending = time_s * time_s * sheet.bending_n_m;
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    vec3 pull = vec3(0.0);
    [[unroll]] for (int y = -2; y <= 2; ++y)
    {
        [[unroll]] for (int x = -2; x <= 2; ++x)
        {
            if (abs(x) * abs(y) != 2 && (x != 0 || y != 0)) {
                float there = columns[2 + x] * rows[2 + y];
                vec4 other = predicted_beside(local, ivec2(x, y), there > 0.0);
                there *= whole_link(torn, x, y);
                vec3 to_other = other.xyz - own.xyz;
                vec2 rest = vec2(abs(x) * sheet.spacing_x_m, abs(y) * sheet.spacing_y_m);
                float share = there * link_pull(to_other, own.w + other.w, length(rest),
                                                max(abs(x), abs(y)) > 1, softness * dot(rest, rest));
                share += bending * (may_tear ? torn_bend_share(x, y, columns, rows, torn)
                                             : grid_bend_share(x, y, columns, rows));
                pull += share * to_other;
            }
        }
    }
    return inverse_mass * pull;
}

vec3 pull_of_lists(uint local, vec4 own, float inverse_mass, float time_s)
{
    vec3 stretch = vec3(0.0);
    vec3 bend = vec3(0.0);
    uvec2 torn = may_tear ? torn_of(local) : uvec2(0u);
    for (uint k = 0u; k < sheet.link_width; ++k) {
        uvec4 words = link_at(local, k);
        vec3 link = uintBitsToFloat(words.yzw); // rest length, compliance and bending of the link
        if (link.x != 0.0 && !(may_tear && has_bit(torn, k))) {
            vec4 other = predicted_at(words.x);
            vec3 to_other = other.xyz - own.xyz;
            stretch += to_other * link_pull(to_other, own.w + other.w, abs(link.x), link.x < 0.0,
                                            link.y / (time_s * time_s));
            bend += torn_bending(link.z, torn, words.x) * to_other;
        }
    }
    return inverse_mass * (stretch + time_s * time_s * sheet.bending_n_m * bend);
}

vec3 pull_of(uint local, vec4 own, float inverse_mass)
{
    float time_s = small_step_s();
    return (variant & cloth_bit_grid) != 0u ? pull_of_grid(local, own, inverse_mass, time_s)
                                            : pull_of_lists(local, own, inverse_mass, time_s);
}

#endif
