// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_PLACES
#define ESTAMPE_STROKE_PLACES

// Positions of samples along strokes, and the sample in the middle of a stroke. Requires before inclusion:
// SAMPLES_BINDING.

#include "techniques/contour/chains/chains.glsl.h"

// Distance on the page from a sample to the next sample, in pixels.
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

// Distance of a sample from the start of the brush, which may lie behind a nearer line.
float arc_on_brush(uint index, Stroke stroke)
{
    return arc_from_start(index, stroke) + spacing_px(index) * float(stroke.steps_behind & 0xffffu);
}

float brush_length(uint index, Stroke stroke)
{
    uint behind = (stroke.steps_behind & 0xffffu) + (stroke.steps_behind >> 16);
    return spacing_px(index) * float(stroke.last - stroke.first + behind);
}

// The sample that decides which stroke of the previous frame a stroke continues. The sample is the middle
// sample of the stroke, because near the stroke's ends a neighbouring stroke may be closer.
uint middle_of(Stroke stroke)
{
    return (stroke.first + stroke.last) / 2u;
}

// Distance of a sample from the middle of the stroke, in samples. One bit tells whether the sample lies
// before or after the middle.
uint from_middle(uint index, Stroke stroke)
{
    uint middle = middle_of(stroke);
    return index >= middle ? 2u * (index - middle) : 2u * (middle - index) - 1u;
}

// Returns the sample for a value of from_middle().
uint sample_from_middle(uint from, Stroke stroke)
{
    uint apart = (from + 1u) / 2u;
    return (from & 1u) == 0u ? middle_of(stroke) + apart : middle_of(stroke) - apart;
}

#endif
