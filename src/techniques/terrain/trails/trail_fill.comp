// SPDX-License-Identifier: MIT
// One thread handles one texel. The wind fills low places of the trails and removes high places. Texels that
// are new in the window become level.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(scalar, binding = 0) buffer Heights
{
    float height_m[];
};

layout(push_constant, scalar) uniform Constants
{
    TrailFill fill;
};

#include "techniques/terrain/trails/trail_texels.glsl"

void main()
{
    const float least_m = 1e-6; // a height below one micrometre counts as 0
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_within(fill.window, texel)) {
        return;
    }
    uint at = kept_at(fill.window, texel);
    float before = height_m[at];
    float height = before;
    if (!is_within(fill.window, texel + ivec2(fill.moved_x, fill.moved_y))) {
        height = 0.0;
    }
    for (uint i = 0u; i < fill.steps && height != 0.0; ++i) {
        height = abs(height) < least_m ? 0.0 : fill.kept * height;
    }
    if (height != before) {
        height_m[at] = height;
    }
}
