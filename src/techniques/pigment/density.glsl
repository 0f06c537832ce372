// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PIGMENT_DENSITY
#define ESTAMPE_PIGMENT_DENSITY

#include "techniques/pigment/pigment.glsl.h"

// Optical density of paint that lets the share `through` of the light through (Beer-Lambert law): twice as
// much paint has twice the density.
vec3 density_of(vec3 through)
{
    return -log(clamp(through, vec3(exp(-pigment_densest)), vec3(1.0)));
}

#endif
