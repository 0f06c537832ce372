// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SLAB_WEIGHTS
#define ESTAMPE_SLAB_WEIGHTS

// Binomial weights over their sum: powers of two make them exact, and no sand is gained. Needs `height`, a
// SlabHeightConstants.

float weight_of_outermost()
{
    return 1.0 / float(1u << (2u * height.radius));
}

// Of the next cell, that of cell `i` counted from the outermost.
float weight_after(float weight, int i)
{
    return weight * float(2 * int(height.radius) - i) / float(i + 1);
}

#endif
