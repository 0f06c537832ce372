// SPDX-License-Identifier: MIT
// One thread handles one sample of a stroke that continues a stroke of the previous frame. If the sample was
// on the previous frame's stroke, the thread adds the sample's offset along the brush to the sum of the new
// stroke.
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
#include "techniques/contour/chains/stroke/stroke_places.glsl"

layout(scalar, binding = 3) readonly buffer Recalls
{
    Recall recalls[];
};

layout(scalar, binding = 4) buffer Strokes
{
    Stroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    RecallConstants constants;
};

const float offset_unit = 16.0; // offsets are summed as integers, in 1/16 pixel
const float most_offset_px = 4096.0;

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count || (sample_at(index).state & piece_is_there) == 0u) {
        return;
    }
    uint stroke = strokes_before(index + 1u) - 1u;
    Recall recall = recalls[index];
    if (constants.stretches != 0u && (sample_at(index).state & sample_in_ring) != 0u) {
        // A closed line has no end: the whole ring shifts by the offset of the sample where the ring is cut.
        float whole = whole_length(index, strokes[stroke]);
        float turn = recalls[strokes[stroke].first].offset_px;
        recall.offset_px -= whole * round((recall.offset_px - turn) / max(whole, 1.0));
    }
    if (recall.seed != no_stroke_seed &&
        recall.seed == recalls[sample_from_middle(strokes[stroke].recalled, strokes[stroke])].seed &&
        abs(recall.offset_px) < most_offset_px) {
        atomicAdd(strokes[stroke].offset_sum, int(offset_unit * recall.offset_px));
        atomicAdd(strokes[stroke].offset_count, 1u);
    }
}
