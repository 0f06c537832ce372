// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SURFACE_IMAGES
#define ESTAMPE_SURFACE_IMAGES

// Packed formats of the images of techniques/surface.

#include "shaders/stroke_kind.glsl.h"

// The word of a pixel in the image Surface::draw: draw call + 1 (0: no surface), and material flags that many
// passes test.

#define DRAW_PAPER (1u << 31) // blank paper: the surface receives shadow, but has neither wash nor outline
#define DRAW_UNLIT (1u << 30)
#define DRAW_EMISSIVE (1u << 29)
#define DRAW_STROKES_SHIFT 26 // position of the bits for the kind of strokes, see shaders/stroke_kind.glsl.h
#define DRAW_NUMBER_MASK ((1u << DRAW_STROKES_SHIFT) - 1u)

bool sees_draw(uint word)
{
    return word != 0u;
}

uint draw_of(uint word)
{
    return (word & DRAW_NUMBER_MASK) - 1u;
}

uint strokes_of(uint word)
{
    return (word >> DRAW_STROKES_SHIFT) & 7u;
}

// Whether a pixel shows no surface, or blank paper. No line is drawn between two pixels without surface or of
// blank paper.
bool is_paper(uint word)
{
    return word == 0u || (word & DRAW_PAPER) != 0u;
}

// Change of a surface coordinate per pixel to the right and down. Packed to 16 bytes: six numbers relative to
// the largest of the six, with a precision of 1/32767.
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
