// SPDX-License-Identifier: MIT
// Four threads test one stroke. A short stroke that runs beside a longer stroke is dropped, for example the
// far side of a cusp. A stroke that was found on the page is also dropped if it runs beside a stroke of the
// mesh, whatever the length. For example, where a box stands on the ground, the box's edge already has a
// line. Scraps, the outlines of bumps and short lines on foliage are dropped too, see is_scrap(), is_bump()
// and is_twig(). For each stroke, the shader resets the data that the stroke inherits from the previous
// frame.
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

layout(binding = 5) uniform usamplerBuffer neighbor_texels;

#define FACING_BINDING 6
#include "techniques/contour/chains/extract/facing.glsl"
#include "techniques/contour/chains/stroke/kind_now.glsl"
#include "techniques/contour/chains/stroke/stroke_places.glsl"
#include "techniques/contour/chains/stroke/meetings.glsl"

layout(scalar, binding = 7) readonly buffer ShellLines
{
    uint has_long_line[]; // for each shell (connected surface): 1 if a stroke of it has the least length
};

layout(push_constant, scalar) uniform Constants
{
    DropConstants constants;
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
// The area that an outline must hide behind it, on the page: a multiple of the shortest stroke's square.
const float least_area = 0.5;
// The least length of a line that closes a gap, as a share of the shortest stroke: a shorter one is a dot.
const float least_closing = 0.6;
// The least lengths of a line around a gap in a clump of leaves, and of a line within a clump, as multiples
// of the size of gaps that are closed.
const float least_hole = 6.0;
const float least_line = 4.0;

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

// Whether a closed line around a clump encloses a gap: the clump lies on the left of its outline.
bool encloses_gap(Stroke stroke)
{
    vec2 origin = sample_at(stroke.first).page_px;
    float area = 0.0;
    for (uint at = stroke.first; at < stroke.last; ++at) {
        vec2 from = sample_at(at).page_px - origin;
        vec2 to = sample_at(at + 1u).page_px - origin;
        area += from.x * to.y - to.x * from.y;
    }
    return area > 0.0;
}

// Whether a line around foliage is too short beside the size of clumps: a closed line around a small gap, or
// a line within a clump, before foliage.
bool is_twig(Stroke stroke)
{
    if (constants.clump_px <= 0.0) {
        return false;
    }
    LineSample middle = sample_at(middle_of(stroke));
    if (middle.source >> 28 != line_clump) {
        return false;
    }
    bool is_ring = (middle.state & sample_in_ring) != 0u;
    bool is_within = (middle.state & sample_is_within) != 0u;
    float least_px = constants.clump_px * (is_ring ? least_hole : least_line);
    return whole_length(stroke.first, stroke) < least_px && (is_within || (is_ring && encloses_gap(stroke)));
}

bool is_beside_longer(uint index, uint own, uint own_steps, bool is_own_of_page)
{
    vec2 here = sample_at(index).page_px;
    bool is_there = false;
    Cells around = cells_around(here, constants.size_px);
    for (ivec2 cell = around.low; !is_there && cell.y <= around.high.y; cell = next_cell(cell, around)) {
        uvec2 found = grid[cell_index(cell, constants.size_px)];
        for (int k = 0; k < 2; ++k) {
            uint other = found.y == 0u ? index : k == 0 ? found.x : found.y - 1u;
            uint stroke = strokes_before(other + 1u) - 1u;
            Stroke line = strokes[stroke];
            uint steps = line.last - line.first;
            bool is_longer = steps > own_steps || (steps == own_steps && stroke < own);
            bool counts =
                stroke != own && (is_longer || (is_own_of_page && !is_of_page(sample_at(other).source)));
            bool hides_own = found.y != 0u && counts && is_beside(here, other, line);
            if (hides_own && !is_twig(line)) {
                is_there = true;
            }
        }
    }
    return is_there;
}

// Whether a stroke is too short to say anything. Short strokes are kept where they are whole lines that close
// a gap in an outline before something far behind. The outline of a small thing that has no longer line is
// kept if it is whole.
bool is_scrap(Stroke stroke, float step_mm)
{
    float length_px = whole_length(stroke.first, stroke);
    bool is_ring = (sample_at(stroke.first).state & sample_in_ring) != 0u;
    uint cuts = is_ring ? 0u
                        : (is_cut_at(stroke.first, stroke.first - 1u) ? 1u : 0u) +
                              (is_cut_at(stroke.last, stroke.last + 1u) ? 1u : 0u);
    // Where the rest of a line is hidden, the line stops short of what hides it.
    if (length_px >= constants.shortest_px + float(cuts) * constants.gap_px) {
        return false;
    }
    uint middle = sample_at(middle_of(stroke)).source;
    uint kind = kind_now(middle);
    bool is_outline = (kind == line_silhouette && !is_shaded_over(middle)) || kind == line_border;
    if (!is_outline) {
        return true;
    }
    bool is_linked = middle >> 28 == line_silhouette;
    bool is_only = has_long_line[shell_of_line(middle)] == 0u;
    bool is_before_far = step_mm * constants.pixels_per_mm >= constants.shortest_px;
    return !(is_only && is_ring) &&
           (is_linked || cuts > 0u || !is_before_far || length_px < least_closing * constants.shortest_px ||
            line_at_end(stroke, stroke.first, constants.size_px, true) == no_sample ||
            line_at_end(stroke, stroke.last, constants.size_px, true) == no_sample);
}

// Whether the outline of a smooth surface hides next to nothing: a bump of a rough surface, not a form.
bool is_bump(Stroke stroke, float step_mm)
{
    float length_px = whole_length(stroke.first, stroke);
    float area_px = length_px * step_mm * constants.pixels_per_mm;
    return sample_at(middle_of(stroke)).source >> 28 == line_silhouette &&
           area_px < least_area * constants.shortest_px * constants.shortest_px;
}

shared uint steps_behind[64]; // for each stroke: sum of the steps in depth at its looked-at samples
shared uint beside[64];       // for each stroke: how many of the stroke's samples lie beside a second stroke

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
        steps_behind[lane] = 0u;
    }
    barrier();
    uint found = 0u;
    uint behind = 0u;
    bool may_be_beside = is_stroke && (steps <= most_steps || of_page);
    for (uint i = turn; is_stroke && i <= sample_steps; i += threads) {
        uint at = first + steps * i / max(sample_steps, 1u);
        found += may_be_beside && is_beside_longer(at, own, steps, of_page) ? 1u : 0u;
        behind += sample_at(at).state >> sample_step_shift & sample_step_most;
    }
    if (found > 0u) {
        atomicAdd(beside[lane], found);
    }
    atomicAdd(steps_behind[lane], behind);
    barrier();
    if (!is_stroke || turn != 0u) {
        return;
    }
    bool is_dropped = float(beside[lane]) > most_share * float(sample_steps + 1u);
    is_dropped = is_dropped || (of_page && steps < least_page_steps);
    float step_mm = float(steps_behind[lane]) / (sample_steps_a_mm * float(sample_steps + 1u));
    is_dropped = is_dropped || is_scrap(strokes[own], step_mm) || is_bump(strokes[own], step_mm) ||
                 is_twig(strokes[own]);
    strokes[own].ends = is_dropped ? stroke_is_dropped : 0u;
    strokes[own].recalled = no_sample;
    strokes[own].offset_sum = 0;
    strokes[own].offset_count = 0u;
    strokes[own].steps_behind = 0u;
}
