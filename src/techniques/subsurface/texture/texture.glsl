// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUBSURFACE_TEXTURE
#define ESTAMPE_SUBSURFACE_TEXTURE

// How wide the blurs of a map are, in texels.

#include "techniques/subsurface/profile.glsl"

// By how much reading between texels blurs.
const float between_texels_variance = 0.25;

// The standard deviation of the map blurred up to a level; of the map itself at -1.
float deviation_tx(int level)
{
    float blurred = (exp2(2.0 * float(level + 1)) - 1.0) / 3.0;
    return sqrt(blurred + between_texels_variance);
}

// From which deviation on Gaussians are taken for the map, rather than for the light as it lies on the page.
float kept_below_tx()
{
    return 0.5 * deviation_tx(-1);
}

// From which deviation on they are taken for a level, rather than for the one before it.
float level_from_tx(int level)
{
    return sqrt(deviation_tx(level - 1) * deviation_tx(level));
}

#endif
