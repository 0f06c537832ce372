// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_PROGRAM
#define ESTAMPE_HEIGHT_PROGRAM

// Defines height_at(place, spacing): the height of a program at a place relative to the anchor (a nearby
// origin), as a dual number. The function leaves out details that are too fine for a grid with the given
// spacing. The function interprets any program, unless the text of one compiled program replaces
// HEIGHT_PROGRAM. The including shader must declare `words`, `texels` and `terrain`.

#include "techniques/terrain/terrain.glsl.h"

#define Real float
#define Real2 vec2
#define Real4 vec4

#ifdef ESTAMPE_HEIGHT_PROGRAM_IS_WRITTEN
uint first_parameter(); // defined as a constant, so that the compiler knows the positions of all words
#else
uint first_parameter()
{
    return terrain.first_parameter;
}
#endif

Real height_number(uint index)
{
    return uintBitsToFloat(words[first_parameter() + index]);
}

Real height_place(uint index)
{
    return uintBitsToFloat(words[index]);
}

int height_cell(uint index)
{
    return int(words[index]);
}

Real height_texel(uint index)
{
    return texelFetch(texels, int(index)).r;
}

#include "techniques/terrain/graph/height_math.glsl"

#ifdef ESTAMPE_HEIGHT_PROGRAM_IS_WRITTEN
HEIGHT_PROGRAM
#else

struct Decoded {
    uint op;
    uint target;
    uint a, b, c;
    uint warp_u, warp_v;
    uint parameter;
    uint place;
    uint count;
};

// Decodes an instruction of four words. Word 1: operation, target register, number of points of a curve. Word
// 2: three input registers. Word 3: two warp registers and the place. Word 4: the first parameter.
Decoded decoded(uint number)
{
    uint first = terrain.first_instruction + 4u * number;
    uvec4 w = uvec4(words[first], words[first + 1u], words[first + 2u], words[first + 3u]);
    return Decoded(w.x & 0xffu, (w.x >> 8) & 0xffu, w.y & 0xffu, (w.y >> 8) & 0xffu, (w.y >> 16) & 0xffu,
                   w.z & 0xffu, (w.z >> 8) & 0xffu, w.w, w.z >> 16, w.x >> 16);
}

vec4 leaf_of(Decoded i, Place p, float spacing_m)
{
    switch (i.op) {
    case height_coordinate_u:
        return coordinate_u(p);
    case height_coordinate_v:
        return coordinate_v(p);
    case height_wave:
        return leaf_sine(p, spacing_m);
    case height_noise:
        return leaf_noise(p, i.parameter, spacing_m);
    case height_fbm:
        return leaf_fbm(p, i.parameter, spacing_m);
    case height_ridged:
        return leaf_ridged(p, i.parameter, spacing_m);
    case height_cellular:
        return leaf_cellular(p, i.parameter, spacing_m);
    case height_texture:
        return leaf_texture(p, i.parameter, spacing_m);
    default:
        return leaf_dunes(p, i.parameter, spacing_m);
    }
}

vec4 value_of(Decoded i, vec4 a, vec4 b, vec4 c)
{
    switch (i.op) {
    case height_constant:
        return dual(height_number(i.parameter));
    case height_add:
        return a + b;
    case height_subtract:
        return a - b;
    case height_multiply:
        return dual_mul(a, b);
    case height_divide:
        return dual_div(a, b);
    case height_minimum:
        return dual_min(a, b);
    case height_maximum:
        return dual_max(a, b);
    case height_lerp:
        return dual_lerp(a, b, c);
    case height_smoothstep:
        return dual_smoothstep(a, b, c);
    case height_power:
        return dual_pow(a, height_number(i.parameter));
    case height_curve:
        return dual_curve(a, i.parameter, i.count);
    case height_sine:
        return dual_sin(a);
    case height_cosine:
        return dual_cos(a);
    case height_absolute:
        return dual_abs(a);
    case height_root:
        return dual_sqrt(a);
    case height_radius:
        return dual_radius(a, b);
    default:
        return dual_angle(a, b);
    }
}

vec4 height_at(vec2 local_m, float spacing_m)
{
    // The last register is one more than programs use. An operation with fewer inputs reads its missing
    // inputs from the last register.
    vec4 registers[height_register_count + 1u];
    registers[height_register_count] = vec4(0.0);
    uint target = 0u;
    for (uint number = 0u; number < terrain.instruction_count; ++number) {
        Decoded i = decoded(number);
        target = i.target;
        if (i.op >= height_coordinate_u) {
            Place p =
                i.warp_u == height_register_count
                    ? place_at(i.place, local_m.x, local_m.y)
                    : place_warped(i.place, local_m.x, local_m.y, registers[i.warp_u], registers[i.warp_v]);
            registers[target] = leaf_of(i, p, spacing_m);
        } else {
            registers[target] = value_of(i, registers[i.a], registers[i.b], registers[i.c]);
        }
    }
    return registers[target];
}

#endif
#endif
