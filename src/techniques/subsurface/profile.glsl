// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PROFILE
#define ESTAMPE_PROFILE

// Burley's profile as a mixture of Gaussians, and how wide the blurs of a map are, in texels.

// The error function within 1.5e-4, after Winitzki.
vec3 error_function(vec3 x)
{
    vec3 squared = x * x;
    return sqrt(1.0 - exp(-squared * (1.27324 + 0.147 * squared) / (1.0 + 0.147 * squared)));
}

// Burley's profile is a mixture of Gaussians whose deviations are those of a half normal distribution, a
// quarter of it of d and three quarters of 3 d: the share of those of at most `deviation`.
vec3 share_below(float deviation, vec3 spread)
{
    vec3 x = 0.70711 * deviation / max(spread, 1e-4);
    return 0.25 * error_function(x) + 0.75 * error_function(x / 3.0);
}

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
