// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_STROKE_MEETINGS
#define ESTAMPE_STROKE_MEETINGS

// Tells whether the end of a stroke meets another line. Requires before inclusion: sample_grid.glsl,
// lists.glsl with SAMPLES_BINDING and STROKES_BEFORE_BINDING, `strokes`, shaders/unit.glsl.

const float meeting_px = 5.0;
// A distant part of a stroke counts as a separate line from the stroke's end on if it is more than far_along
// samples away.
const uint far_along = 8u;

// Whether a sample belongs to a stroke that is not drawn.
bool is_dropped(uint other)
{
    return (strokes[strokes_before(other + 1u) - 1u].ends & stroke_is_dropped) != 0u;
}

// Whether a line lies at the sample `end`, which is the first or the last sample of `stroke`. Strokes that
// are already dropped count only if `with_dropped` is set.
bool meets_line(Stroke stroke, uint end, uvec2 size_px, bool with_dropped)
{
    vec2 here = sample_at(end).page_px;
    bool meets = false;
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
            meets = meets || (counts && size_of(sample_at(other).page_px - here) < meeting_px);
        }
    }
    return meets;
}

#endif
