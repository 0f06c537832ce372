// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_MEETINGS
#define ESTAMPE_STROKE_MEETINGS

// Tells whether the end of a stroke meets another line. Requires before inclusion: sample_grid.glsl,
// lists.glsl with SAMPLES_BINDING and STROKES_BEFORE_BINDING, stroke_places.glsl, `strokes`, `sizes`,
// shaders/unit.glsl.

const float meeting_px = 5.0;
// A distant part of a stroke counts as a separate line from the stroke's end on if it is more than far_along
// samples away.
const uint far_along = 8u;

// Whether a sample belongs to a stroke that is not drawn.
bool is_dropped(uint other)
{
    return (strokes[strokes_before(other + 1u) - 1u].ends & stroke_is_dropped) != 0u;
}

// Whether the line of a stroke's end goes on at the sample `beyond`, but is hidden there.
bool is_cut_at(uint end, uint beyond)
{
    bool is_there = beyond < sizes[list_samples].count;
    uint next = is_there ? beyond : end;
    return is_there && (sample_at(next).state & sample_is_off_page) == 0u &&
           size_of(sample_at(next).page_px - sample_at(end).page_px) < 2.0 * spacing_px(next);
}

// The nearest sample of another line at the sample `end`, which is the first or the last sample of `stroke`;
// no_sample if there is none. Strokes that are already dropped count only if `with_dropped` is set.
uint line_at_end(Stroke stroke, uint end, uvec2 size_px, bool with_dropped)
{
    vec2 here = sample_at(end).page_px;
    uint nearest = no_sample;
    float nearest_px = meeting_px;
    Cells around = cells_around(here, size_px);
    for (ivec2 cell = around.low; cell.y <= around.high.y; cell = next_cell(cell, around)) {
        uvec2 found = grid[cell_index(cell, size_px)];
        for (int k = 0; k < 2; ++k) {
            uint other = k == 0 ? found.x : found.y - 1u;
            bool is_there = found.y != 0u;
            other = is_there ? other : end;
            bool is_own = other >= stroke.first && other <= stroke.last;
            uint apart = other > end ? other - end : end - other;
            bool counts = is_there && (!is_own || apart > far_along) && (with_dropped || !is_dropped(other));
            float away_px = size_of(sample_at(other).page_px - here);
            bool is_nearer = counts && away_px < nearest_px;
            nearest = is_nearer ? other : nearest;
            nearest_px = is_nearer ? away_px : nearest_px;
        }
    }
    return nearest;
}

#endif
