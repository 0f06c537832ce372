// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_SPLINE
#define ESTAMPE_INK_SPLINE

// Quadratic B-splines: weights of three nodes, and the weights' derivatives, at a place that lies `f` node
// spacings (-0.5 to 0.5) beyond the middle node. The curl of a stream function interpolated with quadratic
// B-splines is free of divergence.

vec3 spline_values(float f)
{
    return vec3(0.5f * (0.5f - f) * (0.5f - f), 0.75f - f * f, 0.5f * (0.5f + f) * (0.5f + f));
}

vec3 spline_slopes(float f)
{
    return vec3(f - 0.5f, -2.0f * f, f + 0.5f);
}

vec3 spline_bends()
{
    return vec3(1.0f, -2.0f, 1.0f);
}

#endif
