// SPDX-License-Identifier: MIT
// Does the work of lab_stay.comp in a fragment shader. Pixels without work use discard.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint variant = 0u;

#include "lab_pixels.glsl"

layout(location = 0) out uint result;

void main()
{
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    if ((variant & leaves_early) != 0u && !stays(pixel)) {
        discard;
    }
    uint x = worked_on(pixel);
    result = stays(pixel) ? x : 0u;
}
