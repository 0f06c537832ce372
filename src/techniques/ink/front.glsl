// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_FRONT
#define ESTAMPE_INK_FRONT

// Finds the foreground object next to a pixel, because half of an outline's width is drawn outside the
// object's edge. Requires before inclusion: `globals`, `depth_image`.

const float is_nearer = 1.02; // a pixel that is nearer by the factor is_nearer belongs to a different object

ivec2 pixel_at(vec2 page_px)
{
    return clamp(ivec2(floor(page_px)), ivec2(0), ivec2(globals.page_px) - 1);
}

// Among eight places at distance `away_px` around a pixel, the one whose surface is nearest to the eye; the
// pixel itself if no place has a nearer surface.
vec2 front_place(vec2 page_px, float away_px)
{
    vec2 front_px = page_px;
    float nearest = is_nearer * texelFetch(depth_image, pixel_at(page_px), 0).x + 1e-9;
    for (int i = 0; i < 8; ++i) {
        vec2 towards = vec2(i < 3   ? -1
                            : i < 5 ? 0
                                    : 1,
                            i == 0 || i == 3 || i == 5 ? -1
                            : i == 1 || i == 6         ? 0
                                                       : 1);
        float depth = texelFetch(depth_image, pixel_at(page_px + away_px * towards), 0).x;
        front_px = depth > nearest ? page_px + away_px * towards : front_px;
        nearest = max(nearest, depth);
    }
    return front_px;
}

// About half the width of a contour line, in pixels.
float line_reach_px()
{
    return max(0.5 * globals.px_per_mm, 1.5);
}

#endif
