// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLOTS
#define ESTAMPE_SLOTS

// Which chain a sample belongs to. Wanted before: SLOTS_BINDING, of the samples before each slot, and
// `sizes`.

layout(scalar, binding = SLOTS_BINDING) readonly buffer SamplesBefore
{
    uint samples_before[];
};

uint slot_of_sample(uint index)
{
    uint low = 0u;
    uint high = sizes[LIST_SLOTS].count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (samples_before[middle] <= index) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

#endif
