// SPDX-License-Identifier: MIT
// One in ten pixels has work to do. The other pixels return early, or compute for nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_pixels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) writeonly buffer Results
{
    uint results[];
};

void main()
{
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uint width = b;
    if (pixel.x >= width || pixel.y * width >= threads) {
        return;
    }
    uint i = pixel.y * width + pixel.x;
    if ((variant & leaves_early) != 0u) {
        if (!stays(pixel)) {
            results[i] = 0u;
            return;
        }
        results[i] = worked_on(pixel);
        return;
    }
    uint x = worked_on(pixel);
    results[i] = stays(pixel) ? x : 0u;
}
