// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_MEETING_LIST
#define ESTAMPE_MEETING_LIST

// Sides of the page's lattice between whose ends two shells may meet, in no order, behind the arguments of a
// dispatch with a thread for each. All zeros to begin with, but for one row and one layer of workgroups.
// Wanted before: MEETINGS_BINDING, MEETINGS_ACCESS.

#define MEETINGS_A_GROUP 64u

layout(scalar, binding = MEETINGS_BINDING) MEETINGS_ACCESS buffer Meetings
{
    uint meeting_groups;
    uint meeting_rows;
    uint meeting_layers;
    uint meeting_count;
    uint meeting_sides[]; // twice the point, and 1 for the side down
};

#endif
