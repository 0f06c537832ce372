// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_GROWTH
#define ESTAMPE_FLUID_GROWTH

// Factor by which the volume of fluid of a temperature grows in a step, 1 up to the temperature
// `expands_above`. The excess above that temperature decays to the share `excess_kept`, and the heat, which
// is temperature times volume, stays as it is. So the growth is the temperature before the step, divided by
// the temperature after the step.
float growth_at(float temperature, float expands_above, float excess_kept)
{
    float excess = temperature - expands_above;
    return excess > 0.0 ? temperature / (expands_above + excess * excess_kept) : 1.0;
}

#endif
