// SPDX-License-Identifier: MIT
// One thread handles one sample. If a stroke starts or ends at the sample, the thread stores the sample's
// index in the stroke.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define SAMPLES_BINDING 1
#define STROKES_BEFORE_BINDING 2
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 3) writeonly buffer Strokes
{
    Stroke strokes[];
};

void main()
{
    uint index = gl_GlobalInvocationID.x;
    uint count = sizes[list_samples].count;
    if (index >= count || (sample_at(index).state & piece_is_there) == 0u) {
        return;
    }
    uint stroke = strokes_before(index + 1u) - 1u;
    if (strokes_before(index) == stroke) {
        strokes[stroke].first = index;
    }
    bool ends = index + 1u >= count || (sample_at(index + 1u).state & piece_is_there) == 0u ||
                strokes_before(index + 2u) - 1u != stroke;
    if (ends) {
        strokes[stroke].last = index + 1u;
    }
}
