// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LAB_COMPUTE
#define ESTAMPE_LAB_COMPUTE

// A kernel with one thread per item. Each thread writes one word.

#include "lab.glsl"
#include "shaders/loops.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 0) writeonly buffer Results
{
    uint results[];
};

#endif
