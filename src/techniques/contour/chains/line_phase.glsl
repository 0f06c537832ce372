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

bool has_past(uint index)
{
    return recalls[index].half_width_px >= 0.0;
}

// Arc length in the frame before less that of now: that of the nearest sample with a past, of the same stroke
// if there is one, evened with those around it that agree. It settles slowly to that of the whole stroke,
// which has the brush's own length, where the two are not of different turns or strokes.
float phase_offset(uint index, Stroke stroke, uint seed)
{
    bool has_whole = stroke.offset_count > 0u;
    float whole = has_whole ? float(stroke.offset_sum) / (16.0 * float(stroke.offset_count))
                            : most_start_px * unit_float(hash(seed));
    int nearest = 4 * phase_reach;
    float offset = whole;
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
    offset = count > 0.0 ? sum / count : offset;
    float length_px = unpackHalf2x16(sample_at(index).state).y * float(stroke.last - stroke.first);
    bool settles = has_whole && abs(whole - offset) < most_stretch * length_px;
    return offset + (settles
                         ? clamp(constants.settling * (whole - offset), -most_settling_px, most_settling_px)
                         : 0.0);
}

LineTouch touch_of(uint index, Stroke stroke, float phase_px, vec2 way)
{
    float spacing = unpackHalf2x16(sample_at(index).state).y;
    bool is_ring = (sample_at(index).state & SAMPLE_IN_RING) != 0u;
    uint uses = is_hidden ? BRUSH_HIDDEN : kind_now(sample_at(index).source);
    uses |= index == stroke.first && !is_ring ? TOUCH_IS_START : 0u;
    uses |= index == stroke.last && !is_ring ? TOUCH_IS_END : 0u;
    return LineTouch(phase_px, spacing * float(index - stroke.first),
                     spacing * float(stroke.last - stroke.first), packHalf2x16(way), uses);
}

#endif
