// SPDX-License-Identifier: MIT
// Each workgroup computes the exclusive prefix sums of one part of a list, in rounds; each round processes
// one value per thread of the workgroup. The last workgroup writes the total. The results equal the results
// of scan.comp; scan_spread.comp is for GPUs, where workgroups run in parallel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require

#include "techniques/contour/chains/chains.glsl.h"

#define THREADS 256u
layout(local_size_x = 256) in;

layout(scalar, binding = 0) buffer Sizes
{
    ListSize sizes[];
};

layout(scalar, binding = 1) readonly buffer Values
{
    uint values[];
};

layout(scalar, binding = 2) readonly buffer Sums
{
    uint sums[];
};

layout(scalar, binding = 3) writeonly buffer Before
{
    uint before[];
};

layout(push_constant, scalar) uniform Constants
{
    ScanConstants constants;
};

#include "techniques/contour/chains/scan/list_total.glsl"
#include "techniques/contour/chains/scan/scan_stretch.glsl"

shared uint sum_of_subgroup[THREADS];

// Returns the exclusive prefix sum of `value` over the threads of the workgroup, and the total.
uvec2 sums_of_threads(uint value)
{
    uint running = subgroupExclusiveAdd(value);
    uint sum = subgroupAdd(value);
    barrier(); // no thread may write before all threads have read the values of the previous round
    if (subgroupElect()) {
        sum_of_subgroup[gl_SubgroupID] = sum;
    }
    barrier();
    uint whole = 0u;
    for (uint i = 0u; i < gl_NumSubgroups; ++i) {
        running += i < gl_SubgroupID ? sum_of_subgroup[i] : 0u;
        whole += sum_of_subgroup[i];
    }
    return uvec2(running, whole);
}

void main()
{
    uint thread = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
    uint count = sums[scan_parts];
    uvec2 stretch = stretch_of(gl_WorkGroupID.x, count);
    uint running = sums_of_threads(thread < gl_WorkGroupID.x ? sums[thread] : 0u).y;
    for (uint first = stretch.x; first < stretch.y; first += THREADS) {
        uint i = first + thread;
        uvec2 found = sums_of_threads(i < stretch.y ? value_at(i) : 0u);
        if (i < stretch.y) {
            before[i] = running + found.x;
        }
        running += found.y;
    }
    if (gl_WorkGroupID.x == scan_parts - 1u && thread == 0u) {
        before[count] = running;
        write_total(running);
    }
}
