// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_ITEMS
#define ESTAMPE_ITEMS

// The number of this thread's item, for dispatches that may need more workgroups than one direction allows.
uint item_index()
{
    return gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) + gl_GlobalInvocationID.x;
}

#endif
