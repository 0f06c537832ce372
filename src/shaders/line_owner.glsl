// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_OWNER
#define ESTAMPE_LINE_OWNER

// Finds the surface to which a contour line belongs. Requires `depth_image`, with reversed depth.

const ivec2 ways_about[8] = ivec2[8](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(1, 1),
                                     ivec2(-1, 1), ivec2(-1, -1), ivec2(1, -1));

struct LineOwner {
    ivec2 pixel;
    float depth;
};

// Finds the surface that a contour line belongs to. One half of a line's width lies outside the line's
// surface. The line's surface is the nearest surface in `depth_image` within the pen's reach. At pixels
// without a line, only the pixel itself is sampled.
LineOwner owner_of(ivec2 pixel, float line_cover, float reach_px, ivec2 last)
{
    LineOwner owner = LineOwner(pixel, -1.0);
    int reach = line_cover > 0.0 ? int(reach_px) : 0;
    int steps = min(reach, 2);
    int i = -1;
    do {
        int far = i < 0 ? 0 : (reach * (1 + i / 8) + steps - 1) / max(steps, 1);
        ivec2 at = clamp(pixel + ways_about[i & 7] * far, ivec2(0), last);
        float depth = texelFetch(depth_image, at, 0).x;
        owner.pixel = depth > owner.depth ? at : owner.pixel;
        owner.depth = max(owner.depth, depth);
        ++i;
    } while (i < 8 * steps);
    return owner;
}

#endif
