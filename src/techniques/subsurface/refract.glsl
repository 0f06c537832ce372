// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_REFRACT
#define ESTAMPE_REFRACT

// Lines over the page. Reversed depth is linear along the picture of a straight line, so a ray is a straight
// segment in page positions and depth. A ray that never comes back ends at depth 0.

// The end of a ray in clip space, where its depth is 0: the vanishing point of `along` in perspective, or the
// point on the far plane in parallel projection. The fourth coordinate is not positive if the ray comes
// towards the eye.
vec4 ray_end(vec4 from, vec4 along)
{
    return along * from.z - from * along.z;
}

// Largest share of the way from `from` to `to` that stays within `most_px` of `middle_px` and within the
// rectangle from `low_px` to `high_px`. `from` has to lie within both.
float share_within(vec2 from, vec2 to, vec2 middle_px, float most_px, vec2 low_px, vec2 high_px)
{
    vec2 way = to - from;
    vec2 off = from - middle_px;
    float a = dot(way, way);
    float b = dot(way, off);
    float c = min(dot(off, off) - most_px * most_px, 0.0f);
    float share = a > 0.0f ? (sqrt(max(b * b - a * c, 0.0f)) - b) / a : 1.0f;
    share = min(share, 1.0f);
    share = way.x > 0.0f ? min(share, (high_px.x - from.x) / way.x) : share;
    share = way.x < 0.0f ? min(share, (low_px.x - from.x) / way.x) : share;
    share = way.y > 0.0f ? min(share, (high_px.y - from.y) / way.y) : share;
    share = way.y < 0.0f ? min(share, (low_px.y - from.y) / way.y) : share;
    return max(share, 0.0f);
}

#endif
