// SPDX-License-Identifier: MIT
// One thread compares one point of the page lattice (a grid of points on the page) with its neighbours to the
// right and downwards. If a neighbour shows another shell (connected surface), the two shells may intersect
// in between, so the side between the two points is listed.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/frame.glsl.h"
#include "shaders/loops.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

layout(binding = 2) uniform usamplerBuffer neighbor_texels;

#define MEETINGS_BINDING 3
#define MEETINGS_ACCESS
#include "techniques/contour/chains/extract/meeting_list.glsl"

layout(scalar, binding = 4) writeonly buffer Crossings
{
    uvec2 crossings[];
};

layout(push_constant, scalar) uniform Constants
{
    CellConstants constants;
};

#include "techniques/contour/chains/extract/page_cells.glsl"

// The number of the shell (connected surface) that is seen at a point of the page lattice (a grid of points
// on the page); 0 if nothing is seen at the point or the point lies outside of the page.
uint shell_at(uvec2 point)
{
    ivec2 pixel = min(pixel_of_point(point), ivec2(frame.size_px) - 1);
    uvec2 word = visibility_at(pixel);
    bool is_there = sees_triangle(word) && all(lessThan(point, uvec2(constants.columns, constants.rows)));
    uint flags = texelFetch(neighbor_texels, int(is_there ? seen_triangle(word) : 0u)).w;
    return is_there ? flags >> neighbor_shell_shift : 0u;
}

void list_side(uint side)
{
    uint place = atomicAdd(meeting_count, 1u);
    meeting_sides[place] = side;
    atomicMax(meeting_groups, place / MEETINGS_A_GROUP + 1u);
}

void main()
{
    uvec2 point = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(point, uvec2(constants.columns, constants.rows)))) {
        return;
    }
    uint index = point.y * constants.columns + point.x;
    uint here = shell_at(point);
    crossings[index] = uvec2(0u);
    for (int side = 0; side < loop_rounds(2, int(constants.columns)); ++side) {
        uint there = shell_at(point + uvec2(1 - side, side));
        if (here != 0u && there != 0u && here != there) {
            list_side(2u * index + uint(side));
        }
    }
}
