// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_PLACES
#define ESTAMPE_STROKE_PLACES

// Where a sample is along its stroke. Wanted before: SAMPLES_BINDING.

#include "techniques/contour/chains/chains.glsl.h"

// Lengths on the page, in pixels.
float spacing_px(uint index)
{
    return unpackHalf2x16(sample_at(index).state).y;
}

float arc_from_start(uint index, Stroke stroke)
{
    return spacing_px(index) * float(index - stroke.first);
}

float whole_length(uint index, Stroke stroke)
{
    return spacing_px(index) * float(stroke.last - stroke.first);
}

// A stroke goes on that stroke of the frame before which its middle recalls, as near its ends others may lie
// closer.
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
