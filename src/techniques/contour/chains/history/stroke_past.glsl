// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_PAST
#define ESTAMPE_STROKE_PAST

// Which stroke of the frame before a stroke goes on: that which its middle recalls, as near its ends others
// may lie closer.

#include "techniques/contour/chains/chains.glsl.h"

uint middle_of(Stroke stroke)
{
    return (stroke.first + stroke.last) / 2u;
}

// How far from the middle a sample is, and on which side.
uint from_middle(uint index, Stroke stroke)
{
    uint middle = middle_of(stroke);
    return index >= middle ? 2u * (index - middle) : 2u * (middle - index) - 1u;
}

// The sample that from_middle() gave this for.
uint sample_from_middle(uint from, Stroke stroke)
{
    uint apart = (from + 1u) / 2u;
    return (from & 1u) == 0u ? middle_of(stroke) + apart : middle_of(stroke) - apart;
}

#endif
