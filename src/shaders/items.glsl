// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_ITEMS
#define ESTAMPE_ITEMS

// The number of this thread's item, for dispatches that may need more workgroups than one direction allows.
// They are of 64 threads; gl_WorkGroupSize would be 1 before a shader has said so.
uint item_index()
{
    return gl_GlobalInvocationID.y * (64u * gl_NumWorkGroups.x) + gl_GlobalInvocationID.x;
}

#endif
