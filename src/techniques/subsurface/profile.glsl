// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PROFILE
#define ESTAMPE_PROFILE

// Burley's diffusion profile (spread of light below a surface) as a mixture of Gaussians, and the widths of a
// map's blur levels, in texels.

// The error function within 1.5e-4, after Winitzki.
vec3 error_function(vec3 x)
{
    vec3 squared = x * x;
    return sqrt(1.0 - exp(-squared * (1.27324 + 0.147 * squared) / (1.0 + 0.147 * squared)));
}

// Share of the Gaussians in Burley's profile with a deviation of at most `deviation`. The profile is a
// mixture of Gaussians whose deviations follow half-normal distributions. A quarter of the profile has a
// width of the scattering distance d, three quarters have a width of 3 d.
vec3 share_below(float deviation, vec3 spread)
{
    vec3 x = 0.70711 * deviation / max(spread, 1e-4);
    return 0.25 * error_function(x) + 0.75 * error_function(x / 3.0);
}

// Variance that bilinear interpolation adds to a blur, in squared texels.
const float between_texels_variance = 0.25;

// Standard deviation of a blur level; level -1 is the map itself.
float deviation_tx(int level)
{
    float blurred = (exp2(2.0 * float(level + 1)) - 1.0) / 3.0;
    return sqrt(blurred + between_texels_variance);
}

// Standard deviation above which Gaussians of the diffusion profile read the map. Narrower Gaussians use the
// light on the page.
float kept_below_tx()
{
    return 0.5 * deviation_tx(-1);
}

// Standard deviation above which Gaussians of the diffusion profile read the given blur level. Narrower
// Gaussians read the previous level.
float level_from_tx(int level)
{
    return sqrt(deviation_tx(level - 1) * deviation_tx(level));
}

#endif
