// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_SWAY
#define ESTAMPE_LINE_SWAY

// How a hand strays. What it does at a place of the scene it does there in every frame: lines that meet stray
// together, and closed ones close. Wanted before: `frame`, `constants` with wave_px, camera.glsl, hash.glsl;
// for what comes after sway_at() all that shape.comp binds.

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

// How one stroke differs from the next, and from itself when it is drawn again.

const float again_width = 0.85;
const float again_wave = 7.0; // stretches that are drawn again and those that are not, in waves of the sway

uint hand_seed(uint what)
{
    return hash(constants.seed, 16u * constants.hand + what);
}

// How far beyond its start and its end a stroke runs; where it is negative it stops short.
vec2 ends_px(uint seed)
{
    uint start = hash(seed, hand_seed(1u));
    return constants.jitter_ends_px * (2.0 * vec2(unit_float(start), unit_float(hash(start))) - 1.0);
}

// How far beside the line the hand is.
float offset_at(vec3 anchor)
{
    float aside = constants.jitter_offset_px * stray_at(anchor, 4.0 * constants.wave_px, hand_seed(2u));
    float again = constants.retrace_px * stray_at(anchor, 3.0 * constants.wave_px, hand_seed(4u));
    return aside + (constants.hand > 0u ? again : 0.0);
}

// Share of its width that a stroke has at a sample.
float stray_width(uint index, Stroke stroke, uint seed)
{
    vec3 anchor = sample_at(index).anchor;
    float whole = whole_length(index, stroke);
    float soft = spacing_px(index) + min(0.5 * constants.taper_px, 0.25 * whole);
    float from_start = arc_from_start(index, stroke);
    vec2 to_ends = vec2(from_start, whole - from_start);
    vec2 short_px = max(-ends_px(seed), vec2(0.0));
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    short_px = is_ring ? vec2(0.0) : min(short_px, vec2(0.4 * whole));
    vec2 left = mix(vec2(1.0), smoothstep(vec2(0.0), vec2(soft), to_ends - short_px),
                    greaterThan(short_px, vec2(0.0)));
    float share = min(left.x, left.y);
    share *= 1.0 + constants.jitter_width *
                       clamp(stray_at(anchor, 2.0 * constants.wave_px, hand_seed(6u)), -1.0, 1.0);
    float again = stray_at(anchor, again_wave * constants.wave_px, hand_seed(8u));
    return constants.hand > 0u ? share * again_width * smoothstep(-0.35, 0.1, again) : share;
}

#endif
