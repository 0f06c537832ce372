// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_UNIT
#define ESTAMPE_UNIT

// Unit vectors and their packed format.

// Replaces normalize() for vectors of moderate size. On CPUs the built-in functions spend much time on very
// large and very small vectors.
vec3 unit(vec3 v)
{
    return v * inversesqrt(dot(v, v));
}

float size_of(vec3 v)
{
    return sqrt(dot(v, v));
}

float size_of(vec2 v)
{
    return sqrt(dot(v, v));
}

// Packs unit vectors as two numbers in [-1, 1] (Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014).

vec2 sign_not_zero(vec2 v)
{
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 octahedral_encode(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * sign_not_zero(p);
}

vec3 octahedral_decode(vec2 e)
{
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * sign_not_zero(n.xy);
    }
    return unit(n);
}

uint pack_normal(vec3 n)
{
    return packSnorm2x16(octahedral_encode(n));
}

vec3 unpack_normal(uint packed)
{
    return octahedral_decode(unpackSnorm2x16(packed));
}

#endif
