// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MEETING_LIST
#define ESTAMPE_MEETING_LIST

// An unordered list of the sides of the page's lattice between whose ends two shells may intersect, after the
// arguments of a dispatch with one thread per side. Must be all zeros at first, except for one row and one
// layer of workgroups. Requires before inclusion: MEETINGS_BINDING, MEETINGS_ACCESS.

#define MEETINGS_A_GROUP 64u

layout(scalar, binding = MEETINGS_BINDING) MEETINGS_ACCESS buffer Meetings
{
    uint meeting_groups;
    uint meeting_rows;
    uint meeting_layers;
    uint meeting_count;
    uint meeting_sides[]; // twice the index of the point, plus 1 for the side down
};

#endif
