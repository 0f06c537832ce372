// SPDX-License-Identifier: MIT
// One workgroup computes the exclusive prefix sums of a list, with the total at the end. Each thread sums one
// part of the list. The sums of the parts are scanned within subgroups, then across subgroups. Finally each
// thread reads its part of the list again and writes the prefix sums.
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

layout(scalar, binding = 2) writeonly buffer Before
{
    uint before[];
};

layout(push_constant, scalar) uniform Constants
{
    ScanConstants constants;
};

#include "techniques/contour/chains/scan/list_total.glsl"
#include "techniques/contour/chains/scan/scan_stretch.glsl"

shared uint sums[THREADS];

void main()
{
    uint thread = gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID;
    uint count = constants.fixed_count;
    if (constants.count_of != no_list) {
        count += sizes[constants.count_of].count;
    }
    uint share = (count + THREADS - 1u) / THREADS;
    uint first = min(thread * share, count);
    uint last = min(first + share, count);
    uint sum = 0u;
    for (uint i = first; i < last; ++i) {
        sum += value_at(i);
    }
    uint running = subgroupExclusiveAdd(sum);
    uint subgroup_sum = subgroupAdd(sum);
    if (subgroupElect()) {
        sums[gl_SubgroupID] = subgroup_sum;
    }
    barrier();
    for (uint i = 0u; i < gl_SubgroupID; ++i) {
        running += sums[i];
    }
    for (uint i = first; i < last; ++i) {
        before[i] = running;
        running += value_at(i);
    }
    if (thread == THREADS - 1u) {
        before[count] = running;
        write_total(running);
    }
}
