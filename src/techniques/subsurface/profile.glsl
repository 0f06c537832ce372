// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PROFILE
#define ESTAMPE_PROFILE

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

#endif
