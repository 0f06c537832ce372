// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DISCS
#define ESTAMPE_DISCS

// What one disc, or many at once, hide from a place. Wanted before: discs.glsl.h.

// How much of the area below a node is turned towards `way`, a unit vector, times its cosine: exact for one
// disc and for many that lie flat; what is turned to all sides shows each of them a quarter of its area.
float facing_area(Disc disc, vec3 way)
{
    float along = dot(disc.facing_m2, way);
    float flatness = min(sqrt(dot(disc.facing_m2, disc.facing_m2)) / disc.area_m2, 1.0f);
    float both_sides = mix(0.5f * disc.area_m2, abs(along), flatness);
    return max(0.5f * (both_sides + along), 0.0f);
}

// A cos cos / (pi r^2 + A), of an emitter at `way` from a receiver of that normal; what lies at the radius
// counts for nothing.
float hidden_by_disc(Disc disc, vec3 way, vec3 normal, float radius_m)
{
    float r_2 = dot(way, way);
    if (r_2 <= 1e-12f || disc.area_m2 <= 0.0f) {
        return 0.0f;
    }
    vec3 towards = way * inversesqrt(r_2);
    float left = max(1.0f - r_2 / (radius_m * radius_m), 0.0f);
    float above = max(dot(normal, towards), 0.0f);
    return left * facing_area(disc, -towards) * above / (3.14159265f * r_2 + disc.area_m2);
}

#endif
