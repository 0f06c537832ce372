// SPDX-License-Identifier: MIT
// One thread handles one texel. The thread copies the window's heights to an image that begins at the corner
// of the window, and fades the heights to 0 at the window's edge.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/terrain/terrain.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform samplerBuffer height_m;
layout(binding = 1, r32f) writeonly uniform image2D out_height;

layout(push_constant, scalar) uniform Constants
{
    TrailImageConstants image;
};

#include "techniques/terrain/trails/trail_texels.glsl"

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_within(image.window, texel)) {
        return;
    }
    ivec2 inwards = min(texel, int(image.window.side) - 1 - texel);
    float fade = clamp(float(min(inwards.x, inwards.y)) / float(image.edge), 0.0, 1.0);
    float height = texelFetch(height_m, int(kept_at(image.window, texel))).x;
    imageStore(out_height, texel, vec4(fade * height));
}
