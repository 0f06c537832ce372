// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_SWAY
#define ESTAMPE_LINE_SWAY

// How a hand strays. What it does at a place of the scene it does there in every frame: lines that meet stray
// together, and closed ones close. Wanted before: `frame`, `constants` with wave_px, camera.glsl, hash.glsl.

float lattice_value(ivec3 cell, uint seed)
{
    return unit_float(hash(uint(cell.x) * 0x9e3779b1u ^ uint(cell.y) * 0x85ebca77u ^
                           uint(cell.z) * 0x27d4eb2fu ^ seed * 0xc2b2ae3du));
}

// Value noise in [0, 1], one feature a unit.
float value_noise(vec3 p, uint seed)
{
    ivec3 cell = ivec3(floor(p));
    vec3 f = p - vec3(cell);
    f = f * f * (3.0 - 2.0 * f);
    vec4 near;
    for (int i = 0; i < 4; ++i) {
        ivec3 corner = cell + ivec3(i & 1, i >> 1, 0);
        near[i] = mix(lattice_value(corner, seed), lattice_value(corner + ivec3(0, 0, 1), seed), f.z);
    }
    return mix(mix(near.x, near.y, f.x), mix(near.z, near.w, f.x), f.y);
}

// In [-1, 1], a feature about every `wave_px` of the page: of features that are powers of two in the scene,
// the two nearest.
float stray_at(vec3 anchor, float wave_px, uint seed)
{
    float octave = log2(max(wave_px * pixel_size_m(frame, anchor), 1e-20));
    float low = floor(octave);
    float fine = value_noise(anchor * exp2(-low), seed);
    float coarse = value_noise(anchor * exp2(-low - 1.0), seed + 1u);
    float part = octave - low;
    // The mean of two has less range than one.
    return 2.0 * (mix(fine, coarse, part) - 0.5) * inversesqrt(1.0 - 2.0 * part + 2.0 * part * part);
}

float sway_at(vec3 anchor, uint seed)
{
    return 0.75 * stray_at(anchor, constants.wave_px, seed) +
           0.25 * stray_at(anchor, 0.35 * constants.wave_px, seed + 2u);
}

#endif
