// SPDX-License-Identifier: MIT
// One thread per texel and height field: blurs the field along one axis.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/alternatives/march.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D hard_image;
layout(binding = 1, r16f) writeonly uniform image2D out_visibility;

layout(push_constant, scalar) uniform Constants
{
    MarchConstants march;
};

// Direction of the blur: 1 vertical, 0 horizontal.
layout(constant_id = 0) const uint variant = 0u;

const float deviations_taken_in = 2.5;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = ivec2(march.size) - 1;
    if (any(greaterThan(texel, last))) {
        return;
    }
    uint field = gl_GlobalInvocationID.z;
    ivec2 first_row = ivec2(0, field * march.size.y);
    float deviation = march.blur_texels[field];
    float falloff = deviation > 0.0 ? 0.5 / (deviation * deviation) : 0.0;
    int radius = int(ceil(deviations_taken_in * deviation));
    ivec2 aside = variant != 0u ? ivec2(0, 1) : ivec2(1, 0);
    float sum = 0.0;
    float weights = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        float weight = exp(-falloff * float(i * i));
        sum += weight * texelFetch(hard_image, first_row + clamp(texel + i * aside, ivec2(0), last), 0).x;
        weights += weight;
    }
    imageStore(out_visibility, first_row + texel, vec4(sum / weights));
}
