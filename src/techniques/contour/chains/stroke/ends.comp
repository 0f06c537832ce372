// SPDX-License-Identifier: MIT
// Two threads test whether the ends of one stroke meet further lines. An end that meets a line is drawn up to
// the line; only free ends taper. Where a nearer line hides the rest of a line, the far line stops short of
// it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

layout(local_size_x = 128) in; // 64 strokes with 2 threads each

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define GRID_BINDING 2
#define GRID_ACCESS readonly
#include "techniques/contour/chains/stroke/sample_grid.glsl"

#define SAMPLES_BINDING 1
#define STROKES_BEFORE_BINDING 3
#define SAMPLES_BEFORE_BINDING 6
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) buffer Strokes
{
    Stroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

layout(scalar, binding = 5) uniform Frame
{
    FrameGlobals frame;
};

#include "techniques/contour/chains/stroke/stroke_places.glsl"
#include "techniques/contour/chains/stroke/meetings.glsl"

layout(constant_id = 0) const uint variant = 0u;
const bool has_brushes = (variant & ends_has_brushes) != 0u;

const float least_behind_mm = 1.0; // on the page
const uint most_steps_behind = 64u;

// Whether the line of the sample `near` passes before the line of a stroke's end, and hides the rest of it.
bool is_behind(uint end, uint beyond, uint near)
{
    vec3 anchor = sample_at(end).anchor;
    float behind_m = dot(anchor - sample_at(near).anchor, frame.view_forward);
    return is_cut_at(end, beyond) &&
           behind_m > least_behind_mm * frame.pixels_per_mm * pixel_size_m(frame, anchor);
}

// Number of samples by which a line goes on beyond the sample `end` of a stroke, hidden or not, up to its
// next corner. In a closed chain, the last sample repeats the first.
uint steps_beyond(uint end, int way)
{
    uint slot = slot_of_sample(end, sizes[list_slots].count);
    uint first = samples_before(slot);
    uint last = samples_before(slot + 1u) - 1u;
    bool is_closed = sample_at(first).page_px == sample_at(last).page_px;
    uint steps = 0u;
    uint at = end;
    bool goes_on = true;
    while (goes_on && steps < most_steps_behind) {
        at = is_closed && way > 0 && at == last ? first : is_closed && way < 0 && at == first ? last : at;
        bool is_there = way > 0 ? at < last : at > first;
        uint next = is_there ? uint(int(at) + way) : at;
        goes_on = is_there && (sample_at(at).state & sample_is_corner) == 0u && is_cut_at(at, next);
        at = next;
        steps += goes_on ? 1u : 0u;
    }
    return steps;
}

void main()
{
    uint index = gl_GlobalInvocationID.x / 2u;
    bool is_start = (gl_GlobalInvocationID.x & 1u) == 0u;
    if (index >= sizes[list_strokes].count) {
        return;
    }
    Stroke stroke = strokes[index];
    uint end = is_start ? stroke.first : stroke.last;
    uint near = line_at_end(stroke, end, size_px, false);
    if (near != no_sample) {
        bool stops_short = is_behind(end, is_start ? end - 1u : end + 1u, near);
        uint start_bits = stroke_starts_at_line | (stops_short ? stroke_starts_behind : 0u);
        uint end_bits = stroke_ends_at_line | (stops_short ? stroke_ends_behind : 0u);
        atomicOr(strokes[index].ends, is_start ? start_bits : end_bits);
        if (has_brushes && stops_short) {
            uint steps = steps_beyond(end, is_start ? -1 : 1);
            atomicOr(strokes[index].steps_behind, is_start ? steps : steps << 16);
        }
    }
}
