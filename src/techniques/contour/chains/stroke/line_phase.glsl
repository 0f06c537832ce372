// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_PHASE
#define ESTAMPE_LINE_PHASE

// Where along its brush a stroke is, held to the surface from frame to frame. Wanted before: all that
// shape.comp binds.

const int phase_reach = 6;      // samples to either side that are heard
const float one_phase_px = 3.0; // what is no farther off belongs to the same brush
const float most_stretch = 0.2; // share of a stroke by which its brush may be off its even place
const float most_settling_px = 0.15;
const float most_start_px = 2048.0; // strokes begin anywhere on their brush
const float most_slide = 0.02;      // share of a stretched brush that it slides in a frame
const float least_pace = 0.2;       // of a stretched brush from either end, as a share of the even one

bool has_past(uint index)
{
    return recalls[index].half_width_px >= 0.0;
}

// Place on the brush in the frame before less the arc length of now: that of the nearest sample with a past,
// of the same stroke if there is one, evened with those around it that agree.
float recalled_offset(uint index, Stroke stroke, uint seed, float otherwise)
{
    int nearest = 4 * phase_reach;
    float offset = otherwise;
    for (int i = -phase_reach; i <= phase_reach; ++i) {
        int at = clamp(int(index) + i, int(stroke.first), int(stroke.last));
        int rank = abs(i) + (recalls[at].seed == seed ? 0 : 2 * phase_reach);
        if (rank < nearest && has_past(uint(at))) {
            nearest = rank;
            offset = recalls[at].offset_px;
        }
    }
    float sum = 0.0;
    float count = 0.0;
    for (int i = -phase_reach; i <= phase_reach; ++i) {
        int at = clamp(int(index) + i, int(stroke.first), int(stroke.last));
        if (has_past(uint(at)) && abs(recalls[at].offset_px - offset) < one_phase_px) {
            sum += recalls[at].offset_px;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : offset;
}

// Mean of the whole stroke.
float offset_of(Stroke stroke)
{
    return float(stroke.offset_sum) / (16.0 * float(max(stroke.offset_count, 1u)));
}

// Where on a brush that repeats. It settles slowly to where the whole stroke has the brush's own length,
// where the two are not of different turns or strokes.
float repeated_phase(uint index, Stroke stroke, uint seed)
{
    float arc = arc_from_start(index, stroke);
    float start = most_start_px * unit_float(hash(seed));
    if (!recalls_frame) {
        return arc + start;
    }
    bool has_whole = stroke.offset_count > 0u;
    float whole = has_whole ? offset_of(stroke) : start;
    float offset = recalled_offset(index, stroke, seed, whole);
    bool settles = has_whole && abs(whole - offset) < most_stretch * whole_length(index, stroke);
    float step = clamp(constants.settling * (whole - offset), -most_settling_px, most_settling_px);
    return arc + offset + (settles ? step : 0.0);
}

// Where on a brush that goes from end to end once. Where the stroke was another in the frame before, it
// slides to there; but neither end of the brush is ever far from that of the stroke, which may grow faster. A
// ring has no ends: its brush begins where it did.
float stretched_phase(uint index, Stroke stroke, uint seed)
{
    float arc = arc_from_start(index, stroke);
    float whole = whole_length(index, stroke);
    if (!recalls_frame) {
        return arc;
    }
    if ((sample_at(index).state & sample_in_ring) != 0u) {
        return whole * fract((arc + offset_of(stroke)) / max(whole, 1.0));
    }
    float offset = recalled_offset(index, stroke, seed, 0.0);
    float most = constants.settling > 0.0 ? most_slide * whole : 0.0;
    float phase = arc + offset - clamp(offset, -most, most);
    return clamp(phase, least_pace * arc, whole - least_pace * (whole - arc));
}

LineTouch touch_of(uint index, Stroke stroke, float phase_px, vec2 way)
{
    bool is_ring = (sample_at(index).state & sample_in_ring) != 0u;
    uint uses = is_hidden ? brush_hidden : kind_now(sample_at(index).source);
    uses |= index == stroke.first && !is_ring ? touch_is_start : 0u;
    uses |= index == stroke.last && !is_ring ? touch_is_end : 0u;
    return LineTouch(phase_px, arc_from_start(index, stroke), whole_length(index, stroke), packHalf2x16(way),
                     uses);
}

#endif
