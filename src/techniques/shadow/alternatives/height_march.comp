// SPDX-License-Identifier: MIT
// One thread per texel: walks a ray towards the sun's centre, one texel per step, until the ground is above
// it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/shadow/alternatives/march.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D height_image; // heights, sampled with linear filtering
layout(binding = 1, r16f) writeonly uniform image2D out_visibility;

layout(push_constant, scalar) uniform Constants
{
    MarchConstants march;
};

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(march.size)))) {
        return;
    }
    float ray_m = texelFetch(height_image, texel, 0).x;
    float visible = march.rise_m < 0.0 ? 0.0 : 1.0;
    vec2 place = vec2(texel);
    for (uint i = 0u; i < march.step_count && visible > 0.0; ++i) {
        place += march.sunwards;
        ray_m += march.rise_m;
        if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, vec2(march.size - 1u)))) {
            break;
        }
        if (textureLod(height_image, (place + 0.5) / vec2(march.size), 0.0).x > ray_m) {
            visible = 0.0;
        }
    }
    imageStore(out_visibility, texel, vec4(visible));
}
