// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PAGE_PIECE
#define ESTAMPE_PAGE_PIECE

#include "shaders/unit.glsl"

// Projects a straight line segment to the page and clips the segment to the page and the near plane. Requires
// before inclusion: `frame`, a FrameGlobals.

const float page_margin_px = 32.0;

struct PagePiece {
    float from_w;
    float to_w;
    vec2 kept; // start and end of the visible part, as shares of the segment; equal if nothing is left
    float length_px;
};

vec2 page_position(vec4 clip)
{
    return (0.5 * clip.xy / clip.w + 0.5) * vec2(frame.size_px);
}

// Clips the range `kept` to the part in which a value is not negative. The value changes linearly from `a` at
// the start of the segment to `b` at the segment's end. The code has no branches, because CPU drivers compile
// branches slowly.
void keep_positive(float a, float b, inout vec2 kept)
{
    float share = a / (a - b);
    kept.x = a < 0.0 ? (b > 0.0 ? max(kept.x, share) : 2.0) : kept.x;
    kept.y = b < 0.0 ? (a > 0.0 ? min(kept.y, share) : -1.0) : kept.y;
}

PagePiece piece_on_page(vec3 from, vec3 to)
{
    vec4 a = frame.clip_from_anchor * vec4(from, 1.0);
    vec4 b = frame.clip_from_anchor * vec4(to, 1.0);
    vec2 kept = vec2(0.0, 1.0);
    keep_positive(a.w - a.z, b.w - b.z, kept);
    vec2 reach = 1.0 + 2.0 * page_margin_px / vec2(frame.size_px);
    keep_positive(reach.x * a.w - a.x, reach.x * b.w - b.x, kept);
    keep_positive(reach.x * a.w + a.x, reach.x * b.w + b.x, kept);
    keep_positive(reach.y * a.w - a.y, reach.y * b.w - b.y, kept);
    keep_positive(reach.y * a.w + a.y, reach.y * b.w + b.y, kept);
    vec4 start = mix(a, b, kept.x);
    vec4 end = mix(a, b, kept.y);
    float length_px = size_of(page_position(end) - page_position(start));
    bool is_kept = kept.x < kept.y;
    return PagePiece(is_kept ? start.w : 1.0, is_kept ? end.w : 1.0, is_kept ? kept : vec2(0.0),
                     is_kept ? length_px : 0.0);
}

// Converts a position along the clipped part on the page, in [0, 1], to a share of the whole segment in
// space.
float share_at(PagePiece piece, float along)
{
    float weight = along * piece.from_w;
    return mix(piece.kept.x, piece.kept.y, weight / max(weight + (1.0 - along) * piece.to_w, 1e-20));
}

#endif
