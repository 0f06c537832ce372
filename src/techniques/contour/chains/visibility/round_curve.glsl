// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_ROUND_CURVE
#define ESTAMPE_ROUND_CURVE

// Rounds the kinks of a chain whose surface is shaded smoothly: across the triangles of a coarse mesh a line
// is a polygon, while the shading says that the shape is round. The rounded line is the local mean of the
// polygon with a kernel of fourth order, which keeps lines and parabolas, so a round shape does not shrink.
// Lines that were found on the page lattice have steps, which are evened by a local mean with this kernel.
// Requires before inclusion: lists.glsl with POINTS_BINDING and LENGTHS_BEFORE_BINDING, page_piece.glsl.
//
// Source: Gasser, Mueller and Mammitzsch, "Kernels for Nonparametric Curve Estimation", 1985.

// The points of a chain. In a closed chain, the last point repeats the first.
struct ChainOfPoints {
    uint first;
    uint end;
    bool is_closed;
};

const float least_segment_px = 2.0;    // kinks between shorter segments are too small to be seen
const uint around_place = 4u;          // on either side of a segment, for the mean length
const float least_step_px = 0.5;       // a shorter segment has no direction
const uint most_points_in_reach = 12u; // on either side of a sample
const float sharpest_rad = 1.05;       // a sharper bend is a corner or a cusp, and stays
// Largest sum of the kinks in radians on either side within the kernel, weighted from 1 in its middle to 0 at
// its ends.
const float most_turn = 0.6;
// A single kink is moved by this share of half the kernel's width, times the kink's angle in radians.
const float moved_by_kink = 0.078;
const float straight_rad = 0.01; // a smaller kink is not seen
// Reach of the mean, in steps of the page lattice, over a line that was found on the lattice.
const float lattice_steps = 5.0;

// Index in the point list of point number `place` of a chain. Numbers beyond the ends of an open chain are
// clamped; in a closed chain, they wrap around.
uint point_in(ChainOfPoints chain, int place)
{
    int segments = int(chain.end - chain.first) - 1;
    return chain.first +
           uint(chain.is_closed ? (place + 4 * segments) % segments : clamp(place, 0, segments));
}

vec2 page_of_point(uint point)
{
    return page_position(frame.clip_from_anchor * vec4(point_at(point).anchor, 1.0));
}

// Mean length of the segments around segment number `place`.
float mean_segment_px(ChainOfPoints chain, int place)
{
    uint at = chain.first + uint(place);
    uint from = max(at, chain.first + around_place) - around_place;
    uint to = min(at + 1u + around_place, chain.end - 1u);
    return float(lengths_before(to) - lengths_before(from)) / (length_unit_px * float(to - from));
}

// What lies ahead of a sample on its chain, in one direction, up to the first point that must keep its kink,
// or up to the last point that is looked at. Kinks are weighted from 1 at the sample to 0 at the end of the
// length.
struct Ahead {
    float free_px; // length
    float turn;    // sum of the kinks, in radians
    float kink;    // about the largest of the kinks
};

// Looks ahead from a sample between the points `place` and `place` + 1. `way` is 1 or -1.
Ahead look_ahead(ChainOfPoints chain, int place, int way, vec2 sample_px)
{
    int segments = int(chain.end - chain.first) - 1;
    int at = way > 0 ? place + 1 : place;
    vec2 before = page_of_point(point_in(chain, at - way)); // the last point that is not too close to `here`
    vec2 here = page_of_point(point_in(chain, at));
    float away_px = size_of(here - sample_px);
    bool is_end = false;
    // Sum of the kinks and of their eighth powers, whose eighth root is near the largest kink; below, the
    // same sums, with each kink times its distance.
    vec2 sum = vec2(0.0);
    vec2 moment = vec2(0.0);
    for (uint i = 0u; i < most_points_in_reach && !is_end; ++i) {
        vec2 there = page_of_point(point_in(chain, at + way));
        vec2 arriving = here - before;
        vec2 leaving = there - here;
        // Where a line meets a vertex of the mesh, it has segments that are too short to have a direction.
        bool has_bend = min(size_of(arriving), size_of(leaving)) >= least_step_px;
        float kink = has_bend
                         ? atan(abs(arriving.x * leaving.y - arriving.y * leaving.x), dot(arriving, leaving))
                         : 0.0;
        is_end = (!chain.is_closed && (at <= 0 || at >= segments)) || kink > sharpest_rad ||
                 point_at(point_in(chain, at - 1)).ends_round == 0u;
        if (!is_end) {
            vec2 kinks = vec2(kink, pow(kink, 8.0));
            sum += kinks;
            moment += kinks * away_px;
            before = has_bend ? here : before;
            here = there;
            away_px += size_of(leaving);
            at += way;
        }
    }
    vec2 weighted = max(sum - moment / max(away_px, 1e-3), vec2(0.0));
    return Ahead(away_px, weighted.x, pow(weighted.y, 0.125));
}

// Integrals from 0 to u of the kernel 15/32 (1 - u^2) (3 - 7 u^2), and of u times the kernel.
vec2 kernel_integrals(float u)
{
    float square = u * u;
    return 15.0 / 32.0 *
           vec2(u * (3.0 + square * (-10.0 / 3.0 + 7.0 / 5.0 * square)),
                square * (1.5 + square * (-2.5 + 7.0 / 6.0 * square)));
}

// Sum of the polygon's positions relative to a sample, weighted by half of the kernel, in one direction.
vec2 sum_ahead(ChainOfPoints chain, int place, int way, vec2 sample_px, float reach_px)
{
    int at = way > 0 ? place + 1 : place;
    vec2 from = vec2(0.0);
    vec2 sum = vec2(0.0);
    float u = 0.0;
    vec2 before = vec2(0.0);
    for (uint i = 0u; i <= most_points_in_reach && u < 1.0; ++i) {
        vec2 to = page_of_point(point_in(chain, at)) - sample_px;
        float step = max(size_of(to - from) / reach_px, 1e-6);
        vec2 slope = (to - from) / step; // growth of the position with u
        vec2 after = kernel_integrals(min(u + step, 1.0));
        sum += (from - slope * u) * (after.x - before.x) + slope * (after.y - before.y);
        from = to;
        before = after;
        u += step;
        at += way;
    }
    return sum;
}

// Position of a sample on the rounded line. `place` is the number of the chain's segment that contains the
// sample. The rounded line is at most `most_px` beside the polygon.
vec2 rounded_position(ChainOfPoints chain, int place, vec2 sample_px, float most_px)
{
    if (mean_segment_px(chain, place) < least_segment_px || most_px <= 0.0) {
        return sample_px;
    }
    Ahead back = look_ahead(chain, place, -1, sample_px);
    Ahead on = look_ahead(chain, place, 1, sample_px);
    float turn = max(back.turn, on.turn);
    if (turn < straight_rad) {
        return sample_px;
    }
    float reach_px = min(back.free_px, on.free_px);
    float by_kink_px = most_px / (moved_by_kink * max(max(back.kink, on.kink), 1e-6));
    reach_px = max(min(reach_px * min(1.0, most_turn / turn), by_kink_px), 1e-3);
    vec2 moved_px =
        sum_ahead(chain, place, -1, sample_px, reach_px) + sum_ahead(chain, place, 1, sample_px, reach_px);
    float by_px = size_of(moved_px);
    // A point beside the page may have no position on it; then the line stays as it is.
    return by_px < 4.0 * most_px ? sample_px + moved_px * min(1.0, most_px / max(by_px, 1e-6)) : sample_px;
}

// Position of a sample on a line that was found on the page lattice, without the steps of the lattice.
vec2 evened_position(ChainOfPoints chain, int place, vec2 sample_px)
{
    float reach_px = lattice_steps * float(cell_px);
    if (!chain.is_closed) {
        uint at = chain.first + uint(place);
        uint left = min(lengths_before(at) - lengths_before(chain.first),
                        lengths_before(chain.end - 1u) - lengths_before(min(at + 1u, chain.end - 1u)));
        reach_px = clamp(float(left) / length_unit_px, 1e-3, reach_px);
    }
    vec2 moved_px =
        sum_ahead(chain, place, -1, sample_px, reach_px) + sum_ahead(chain, place, 1, sample_px, reach_px);
    return sample_px + moved_px * min(1.0, float(cell_px) / max(size_of(moved_px), 1e-6));
}

#endif
