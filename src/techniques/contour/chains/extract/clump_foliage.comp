// SPDX-License-Identifier: MIT
// One thread compares one point of the page lattice (a grid of points on the page) with eight points around
// it, on a ring. If clumps of foliage grow, the point takes over the nearest foliage on the ring that lies in
// front of it. If clumps shrink, a point with foliage takes over the farthest surface on the ring. Several
// rings, each about half as large as the one before, grow or shrink clumps by nearly a circle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 1) writeonly buffer Foliage
{
    uvec2 points[];
};

layout(push_constant, scalar) uniform Constants
{
    FoliageConstants constants;
};

#define FOLIAGE_BINDING 0
#include "techniques/contour/chains/extract/foliage.glsl"

void main()
{
    uvec2 point = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(point, uvec2(constants.columns, constants.rows)))) {
        return;
    }
    FoliagePoint own = foliage_at(ivec2(point));
    bool shrinks = constants.shrinks != 0u;
    FoliagePoint best = own;
    int count = shrinks && !is_foliage(own) ? 0 : 8;
    for (int i = 0; i < loop_rounds(count, int(constants.columns)); ++i) {
        FoliagePoint other = foliage_at(ivec2(point) + constants.ring[i]);
        uint other_depth = other.place & foliage_depth_mask;
        uint best_depth = best.place & foliage_depth_mask;
        bool grows_here = is_foliage(other) && other_depth > best_depth;
        bool shrinks_here = is_foliage(own) && other_depth < best_depth;
        if (shrinks ? shrinks_here : grows_here) {
            best = other;
        }
    }
    points[point.y * constants.columns + point.x] = uvec2(best.place, best.pixel);
}
