// SPDX-License-Identifier: MIT
// Each workgroup sums one of the scan_parts parts of a list. The shader scan_spread.comp reads these sums.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require

#include "techniques/contour/chains/chains.glsl.h"

#define THREADS 256u
layout(local_size_x = 256) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer Values
{
    uint values[];
};

layout(scalar, binding = 2) writeonly buffer Sums
{
    uint sums[]; // sum of the values of each part; the last entry is the length of the list
};

layout(push_constant, scalar) uniform Constants
{
    ScanConstants constants;
};

#include "techniques/contour/chains/scan/scan_stretch.glsl"

shared uint sum_of_subgroup[THREADS];

void main()
{
    uint count = constants.fixed_count;
    if (constants.count_of != no_list) {
        count += sizes[constants.count_of].count;
    }
    uvec2 stretch = stretch_of(gl_WorkGroupID.x, count);
    uint sum = 0u;
    for (uint i = stretch.x + gl_LocalInvocationID.x; i < stretch.y; i += THREADS) {
        sum += value_at(i);
    }
    sum = subgroupAdd(sum);
    if (subgroupElect()) {
        sum_of_subgroup[gl_SubgroupID] = sum;
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        uint whole = 0u;
        for (uint i = 0u; i < gl_NumSubgroups; ++i) {
            whole += sum_of_subgroup[i];
        }
        sums[gl_WorkGroupID.x] = whole;
        if (gl_WorkGroupID.x == 0u) {
            sums[scan_parts] = count;
        }
    }
}
