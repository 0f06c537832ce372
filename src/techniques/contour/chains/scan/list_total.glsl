// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LIST_TOTAL
#define ESTAMPE_LIST_TOTAL

// Stores the total of a prefix sum as the length of a list.
void write_total(uint total)
{
    uint kept = min(total, constants.capacity);
    if (constants.total_to != no_list) {
        sizes[constants.total_to] = ListSize(kept, (kept + 63u) / 64u, 1u, 1u);
    }
    if (constants.slots_before != no_list) {
        uint slots = constants.slots_before + kept;
        sizes[list_slots] = ListSize(slots, (slots + 63u) / 64u, 1u, 1u);
    }
}

#endif
