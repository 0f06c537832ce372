// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRAIL_TEXELS
#define ESTAMPE_TRAIL_TEXELS

// Index in memory at which a texel of the window is stored.
uint kept_at(TrailWindow window, ivec2 texel)
{
    ivec2 wrapped = (texel + ivec2(window.first_x, window.first_y)) & (int(window.side) - 1);
    return uint(wrapped.y) * window.side + uint(wrapped.x);
}

bool is_within(TrailWindow window, ivec2 texel)
{
    return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(window.side)));
}

#endif
