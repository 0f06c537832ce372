// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_UNIT
#define ESTAMPE_UNIT

// As normalize and length are, but for vectors of middling size only: processors pay much for what those do
// about very large and very small ones.
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

#endif
