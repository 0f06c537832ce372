// SPDX-License-Identifier: MIT
// Sums the ink's coverage of the page. Each thread reads eight pixels, one of every four.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "techniques/ink/ink.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(scalar, binding = 1) uniform Ink
{
    InkGlobals globals;
};

layout(binding = 2) uniform usamplerBuffer state_texels;

layout(scalar, binding = 3) buffer Sums
{
    InkSums sums;
};

layout(push_constant, scalar) uniform Constants
{
    InkMeasure measure;
};

layout(constant_id = 0) const uint variant = 0u;
const bool is_around = (variant & ink_is_around) != 0u;

#include "techniques/ink/grid.glsl"
#include "techniques/ink/cover.glsl"
#include "techniques/ink/page_ink.glsl"

shared uint covered;

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        covered = 0u;
    }
    barrier();
    uvec2 size = measured_size();
    uint sum = 0u;
    for (uint i = 0u; i < ink_block; ++i) {
        uvec2 at = uvec2(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y * ink_block + i);
        if (all(lessThan(at, size))) {
            sum += uint(ink_measured * ink_cover(ink_on_page(2.0 * vec2(at) + 0.5)).x + 0.5);
        }
    }
    atomicAdd(covered, sum);
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        atomicAdd(sums.covered[measure.sum_now], covered);
    }
}
