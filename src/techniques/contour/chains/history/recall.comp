// SPDX-License-Identifier: MIT
// One thread finds where one sample was in the previous frame, and which line in the sample's direction was
// drawn at that place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
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

layout(scalar, binding = 3) buffer Strokes
{
    Stroke strokes[];
};

#define GRID_BINDING 4
#define GRID_ACCESS readonly
#include "techniques/contour/chains/stroke/sample_grid.glsl" // the sample grid of the previous frame

layout(scalar, binding = 5) readonly buffer DrawnSamples
{
    DrawnSample drawn[];
};

layout(scalar, binding = 6) writeonly buffer Recalls
{
    Recall recalls[];
};

layout(push_constant, scalar) uniform Constants
{
    RecallConstants constants;
};

const float reach_px = 5.0;
const float same_way = 0.7;

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= sizes[list_samples].count) {
        return;
    }
    bool goes_on = (sample_at(index).state & piece_is_there) != 0u;
    bool was_on = index > 0u && (sample_at(index - 1u).state & piece_is_there) != 0u;
    Recall recall = Recall(-1.0, 0.0, no_stroke_seed);
    if (goes_on || was_on) {
        uvec2 size_px = uvec2(constants.width, constants.height);
        vec4 clip = constants.clip_from_anchor_before * vec4(sample_at(index).anchor, 1.0);
        vec2 page = (0.5 * clip.xy / clip.w + 0.5) * vec2(size_px);
        vec2 way = goes_on ? sample_at(index + 1u).page_px - sample_at(index).page_px
                           : sample_at(index).page_px - sample_at(index - 1u).page_px;
        way *= inversesqrt(max(dot(way, way), 1e-20));
        uint stroke = strokes_before(goes_on ? index + 1u : index) - 1u;
        // A stroke that is dropped in the current frame may continue a stroke that was fading out in the
        // previous frame. A drawn stroke continues only drawn strokes.
        bool is_dropped = (strokes[stroke].ends & stroke_is_dropped) != 0u;
        float arc = arc_on_brush(index, strokes[stroke]);
        float whole = brush_length(index, strokes[stroke]);
        float nearest = reach_px;
        Cells around = cells_around(page, size_px);
        for (ivec2 cell = around.low; cell.y <= around.high.y; cell = next_cell(cell, around)) {
            uvec2 found = grid[cell_index(cell, size_px)];
            for (int k = 0; k < 2; ++k) {
                DrawnSample there = drawn[found.y == 0u ? 0u : k == 0 ? found.x : found.y - 1u];
                float away = size_of(there.page_px - page);
                bool counts = is_dropped || there.half_width_px > 0.0;
                if (found.y != 0u && counts && away < nearest &&
                    dot(unpackHalf2x16(there.direction), way) > same_way) {
                    nearest = away;
                    float along = dot(page - there.page_px, way);
                    float scale = constants.stretches != 0u ? whole / max(there.whole_px, 1.0) : 1.0;
                    recall = Recall(there.half_width_px, scale * (there.arc_px + along) - arc, there.seed);
                }
            }
        }
        if (recall.seed != no_stroke_seed) {
            atomicMin(strokes[stroke].recalled, from_middle(index, strokes[stroke]));
        }
    }
    recalls[index] = recall;
}
