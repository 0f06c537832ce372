// SPDX-License-Identifier: MIT
// One thread per texel of a half-size image averages four texels; repeated halving approximates a tent blur.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D whole_image;
layout(binding = 1, rgba16f) writeonly uniform image2D out_half;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(out_half)))) {
        return;
    }
    ivec2 last = textureSize(whole_image, 0) - 1;
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        sum += 0.25 * texelFetch(whole_image, min(2 * texel + ivec2(i & 1, i >> 1), last), 0);
    } while (++i < 4);
    imageStore(out_half, texel, sum);
}
