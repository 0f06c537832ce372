// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_OWNER
#define ESTAMPE_LINE_OWNER

// Whoever includes this has `depth_image`, reversed.

const ivec2 ways_about[8] = ivec2[8](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(1, 1),
                                     ivec2(-1, 1), ivec2(-1, -1), ivec2(1, -1));

// Half of a line lies beyond the edge of what it belongs to: that is the nearest of what is seen within the
// pen's reach, `depth_image` says where.
ivec2 owner_of(ivec2 pixel, float line_cover, float reach_px, ivec2 last)
{
    ivec2 owner = pixel;
    float nearest = texelFetch(depth_image, pixel, 0).x;
    int reach = line_cover > 0.0 ? int(reach_px) : 0;
    int steps = min(reach, 2);
    for (int i = 0; i < 8 * steps; ++i) {
        ivec2 at =
            clamp(pixel + ways_about[i & 7] * ((reach * (1 + i / 8) + steps - 1) / steps), ivec2(0), last);
        float depth = texelFetch(depth_image, at, 0).x;
        owner = depth > nearest ? at : owner;
        nearest = max(nearest, depth);
    }
    return owner;
}

#endif
