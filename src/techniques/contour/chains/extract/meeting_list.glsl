// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MEETING_LIST
#define ESTAMPE_MEETING_LIST

// An unordered list of the sides of the page lattice (a grid of points on the page) across which two shells
// (connected surfaces) may intersect. The list follows the arguments of an indirect dispatch with one thread
// per side. The buffer must be zero at first, except for one row and one layer of workgroups. Requires before
// inclusion: MEETINGS_BINDING, MEETINGS_ACCESS.

#define MEETINGS_A_GROUP 64u

layout(scalar, binding = MEETINGS_BINDING) MEETINGS_ACCESS buffer Meetings
{
    uint meeting_groups;
    uint meeting_rows;
    uint meeting_layers;
    uint meeting_count;
    // Each entry: twice the index of a lattice point, plus 1 for the side down from the point, plus 0 for the
    // side to the right.
    uint meeting_sides[];
};

#endif
