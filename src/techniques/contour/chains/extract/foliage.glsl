// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FOLIAGE
#define ESTAMPE_FOLIAGE

// What the page lattice (a grid of points on the page) shows, for lines around clumps of leaves. Requires
// before inclusion: `constants` with the members columns and rows; FOLIAGE_BINDING.

// A point of the lattice. `place` holds the reversed depth (1 at the near plane, 0 at infinity) in the upper
// bits, then 7 bits for the lightness of the tone (127 is white), and the lowest bit says that the point
// shows foliage. Numbers of nearer points are larger. `pixel` is the pixel whose surface is seen at the
// point, which lies elsewhere if the point was added to a clump: y << 16 | x.
struct FoliagePoint {
    uint place;
    uint pixel;
};

layout(binding = FOLIAGE_BINDING) uniform usamplerBuffer foliage_texels;

FoliagePoint foliage_at(ivec2 point)
{
    ivec2 inside = clamp(point, ivec2(0), ivec2(constants.columns, constants.rows) - 1);
    uvec2 words = texelFetch(foliage_texels, inside.y * int(constants.columns) + inside.x).xy;
    return FoliagePoint(words.x, words.y);
}

bool is_foliage(FoliagePoint point)
{
    return (point.place & 1u) != 0u;
}

float depth_of(FoliagePoint point)
{
    return uintBitsToFloat(point.place & foliage_depth_mask);
}

float light_of(FoliagePoint point)
{
    return float(point.place >> 1 & 127u) / 127.0;
}

#endif
