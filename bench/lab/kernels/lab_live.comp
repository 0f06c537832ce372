// SPDX-License-Identifier: MIT
// Dependent reads, in threads that keep KEPT numbers alive: 4, 32 or 128. ALL(M) calls M with a name for
// every four numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "lab_compute.glsl"

layout(scalar, binding = 1) readonly buffer Words
{
    uint words[];
};

#define EIGHT(M, s) M(s##a) M(s##b) M(s##c) M(s##d) M(s##e) M(s##f) M(s##g) M(s##h)
#if KEPT == 4
#define ALL(M) M(sa)
#elif KEPT == 32
#define ALL(M) EIGHT(M, s)
#else
#define ALL(M) EIGHT(M, s) EIGHT(M, t) EIGHT(M, u) EIGHT(M, v)
#endif

#define NAMED(id) uvec4 kept_##id = uvec4(words[(q = next_of(q)) & a], words[(q = next_of(q)) & a], q, q ^ b);
#define TOUCHED(id) kept_##id += p;
#define SUMMED(id) sum += kept_##id.x + kept_##id.y + kept_##id.z + kept_##id.w;

void main()
{
    uint i = item_index();
    if (i >= threads) {
        return;
    }
    uint p = scattered(i) & a;
    uint q = i;
    ALL(NAMED)
    uint sum = 0u;
    for (uint r = 0u; r < rounds; ++r) {
        p = words[p];
        sum += p;
        if (p > a) { // never true, but the compiler cannot know this and must keep the numbers
            ALL(TOUCHED)
        }
    }
    ALL(SUMMED)
    results[i] = sum;
}
