// SPDX-License-Identifier: MIT
// One thread averages the lightness of the tone of foliage around one point of the page lattice (a grid of
// points on the page), along a row or a column. Two passes, along rows and then along columns, give the mean
// over a square, with weights that fall linearly to the square's sides.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

#define FOLIAGE_BINDING 0

layout(binding = 1) uniform usamplerBuffer sum_texels;

layout(scalar, binding = 2) writeonly buffer Sums
{
    // Sum of the lightness, and of the weights of all points that show foliage, as two half floats.
    uint sums[];
};

layout(push_constant, scalar) uniform Constants
{
    FoliageConstants constants;
};

#include "techniques/contour/chains/extract/foliage.glsl"

layout(constant_id = 0) const uint variant = 0u;
const bool adds_rows = (variant & light_foliage_adds_rows) != 0u;

vec2 sum_at(ivec2 point)
{
    if (!adds_rows) {
        FoliagePoint seen = foliage_at(point);
        return is_foliage(seen) ? vec2(lightness_of(seen), 1.0) : vec2(0.0);
    }
    return unpackHalf2x16(texelFetch(sum_texels, point.y * int(constants.columns) + point.x).x);
}

void main()
{
    ivec2 point = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(constants.columns, constants.rows) - 1;
    if (any(greaterThan(point, last))) {
        return;
    }
    int reach = int(constants.reach);
    // Mesa 22.3 computes `adds_rows ? ivec2(0, 1) : ivec2(1, 0)` wrongly, because adds_rows is a
    // specialization constant.
    ivec2 way = ivec2(adds_rows ? 0 : 1, adds_rows ? 1 : 0);
    vec2 sum = vec2(0.0);
    // Every second point is enough for a smooth mean.
    for (int i = -reach; i <= reach; i += 2) {
        sum += (1.0 - abs(float(i)) / float(reach + 1)) * sum_at(clamp(point + i * way, ivec2(0), last));
    }
    sums[point.y * int(constants.columns) + point.x] = packHalf2x16(2.0 * sum / float(reach + 1));
}
