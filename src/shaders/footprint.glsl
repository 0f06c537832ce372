// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FOOTPRINT
#define ESTAMPE_FOOTPRINT

// How a surface coordinate changes over one pixel, to the right and down: six numbers in 16 bytes, as parts
// of the largest of them, to 1/32767.
struct Footprint {
    vec3 dx;
    vec3 dy;
};

uvec4 pack_footprint(Footprint f)
{
    vec3 largest = max(abs(f.dx), abs(f.dy));
    float scale = max(max(largest.x, largest.y), max(largest.z, 1e-30));
    return uvec4(packSnorm2x16(f.dx.xy / scale), packSnorm2x16(vec2(f.dx.z, f.dy.x) / scale),
                 packSnorm2x16(f.dy.yz / scale), floatBitsToUint(scale));
}

Footprint unpack_footprint(uvec4 packed)
{
    float scale = uintBitsToFloat(packed.w);
    vec2 a = unpackSnorm2x16(packed.x) * scale;
    vec2 b = unpackSnorm2x16(packed.y) * scale;
    vec2 c = unpackSnorm2x16(packed.z) * scale;
    return Footprint(vec3(a, b.x), vec3(b.y, c));
}

#endif
