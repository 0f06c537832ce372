// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLAB_WEIGHTS
#define ESTAMPE_SLAB_WEIGHTS

// Normalised binomial weights for smoothing heights. The sum of the weights is a power of two, so the results
// are exact and no sand is gained or lost. The including shader must declare `height`, a SlabHeightConstants.

float weight_of_outermost()
{
    return 1.0 / float(1u << (2u * height.radius));
}

// The weight of cell `i` + 1, computed from the weight of cell `i`. Cells are counted from the outermost cell
// of the smoothing range.
float weight_after(float weight, int i)
{
    return weight * float(2 * int(height.radius) - i) / float(i + 1);
}

#endif
