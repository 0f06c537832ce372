// SPDX-License-Identifier: MIT
// Four threads test one stroke. A short stroke that runs beside a longer stroke is dropped, for example the
// far side of a cusp. A stroke that was found on the page is also dropped if it runs beside a stroke of the
// mesh, whatever the length. For example, where a box stands on the ground, the box's edge already has a
// line. The shader also resets the data that strokes inherit from the previous frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/unit.glsl"
#include "techniques/contour/chains/chains.glsl.h"

const uint threads = 4u;       // threads per stroke
layout(local_size_x = 256) in; // 64 strokes with 4 threads each

layout(scalar, binding = 0) readonly buffer Sizes
{
    ListSize sizes[];
};

#define GRID_BINDING 2
#define GRID_ACCESS readonly
#include "techniques/contour/chains/stroke/sample_grid.glsl"

#define SAMPLES_BINDING 1
#define STROKES_BEFORE_BINDING 3
#include "techniques/contour/chains/lists.glsl"

layout(scalar, binding = 4) buffer Strokes
{
    Stroke strokes[];
};

layout(push_constant, scalar) uniform Constants
{
    uvec2 size_px;
};

const float beside_px = 4.0;
// Largest distance along a stroke between the tested place and the stroke's nearest sample.
const float foot_px = 2.0;
// A place closer than least_inside_px to the end of a stroke does not lie beside the stroke.
const float least_inside_px = 0.5;
const uint most_steps = 10u;
// Smallest number of steps of a stroke found on the page; shorter strokes are specks.
const uint least_page_steps = 3u;
// Largest share of a kept stroke's samples that may lie beside a second stroke.
const float most_share = 0.5;

// Whether a place lies beside the stroke `stroke` of the sample `other`: not before the stroke's start or
// after its end.
bool is_beside(vec2 here, uint other, Stroke stroke)
{
    uint previous = max(other, stroke.first + 1u) - 1u;
    uint next = min(other + 1u, stroke.last);
    vec2 way = sample_at(next).page_px - sample_at(previous).page_px;
    vec2 away = here - sample_at(other).page_px;
    float along = dot(away, way) * inversesqrt(max(dot(way, way), 1e-12));
    bool is_ring = (sample_at(other).state & sample_in_ring) != 0u;
    bool is_outside = !is_ring && ((other == stroke.first && along < least_inside_px) ||
                                   (other == stroke.last && along > -least_inside_px));
    return size_of(away) < beside_px && abs(along) < foot_px && !is_outside;
}

bool is_beside_longer(uint index, uint own, uint own_steps, bool is_own_of_page)
{
    vec2 here = sample_at(index).page_px;
    bool is_there = false;
    Cells around = cells_around(here, size_px);
    for (ivec2 cell = around.low; !is_there && cell.y <= around.high.y; cell = next_cell(cell, around)) {
        uvec2 found = grid[cell_index(cell, size_px)];
        for (int k = 0; k < 2; ++k) {
            uint other = found.y == 0u ? index : k == 0 ? found.x : found.y - 1u;
            uint stroke = strokes_before(other + 1u) - 1u;
            Stroke line = strokes[stroke];
            uint steps = line.last - line.first;
            bool is_longer = steps > own_steps || (steps == own_steps && stroke < own);
            bool counts =
                stroke != own && (is_longer || (is_own_of_page && !is_of_page(sample_at(other).source)));
            is_there = is_there || (found.y != 0u && counts && is_beside(here, other, line));
        }
    }
    return is_there;
}

shared uint beside[64]; // for each stroke: how many of the stroke's samples lie beside a second stroke

void main()
{
    uint lane = gl_LocalInvocationID.x / threads;
    uint own = 64u * gl_WorkGroupID.x + lane;
    bool is_stroke = own < sizes[list_strokes].count;
    uint first = is_stroke ? strokes[own].first : 0u;
    uint steps = is_stroke ? strokes[own].last - first : 0u;
    bool of_page = is_stroke && is_of_page(sample_at(first).source);
    uint sample_steps = min(steps, most_steps);
    uint turn = gl_LocalInvocationID.x % threads;
    if (turn == 0u) {
        beside[lane] = 0u;
    }
    barrier();
    uint found = 0u;
    for (uint i = turn; is_stroke && i <= sample_steps; i += threads) {
        uint at = first + (of_page ? steps * i / max(sample_steps, 1u) : i);
        found += is_beside_longer(at, own, steps, of_page) ? 1u : 0u;
    }
    if (found > 0u) {
        atomicAdd(beside[lane], found);
    }
    barrier();
    if (!is_stroke || turn != 0u) {
        return;
    }
    bool is_dropped =
        (steps <= most_steps || of_page) && float(beside[lane]) > most_share * float(sample_steps + 1u);
    is_dropped = is_dropped || (of_page && steps < least_page_steps);
    strokes[own].ends = is_dropped ? stroke_is_dropped : 0u;
    strokes[own].recalled = no_sample;
    strokes[own].offset_sum = 0;
    strokes[own].offset_count = 0u;
}
