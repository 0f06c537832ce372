// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_LENGTHS
#define ESTAMPE_STROKE_LENGTHS

// Lengths on the page along the stroke that a sample is of, in pixels. Wanted before: SAMPLES_BINDING.

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

#endif
