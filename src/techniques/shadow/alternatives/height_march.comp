// SPDX-License-Identifier: MIT
// One thread handles one texel of one height field. The thread follows a ray towards the sun's centre, one
// texel per step, until the ground is above the ray.
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
    uint field = gl_GlobalInvocationID.z;
    vec2 first_row = vec2(0.0, field * march.size.y);
    vec2 image_size = vec2(march.size.x, march.field_count * march.size.y);
    float rise_m = march.rise * march.texel_m[field];
    if (any(greaterThanEqual(texel, ivec2(march.size)))) {
        return;
    }
    ivec2 stored_at = texel + ivec2(first_row);
    float ray_m = texelFetch(height_image, stored_at, 0).x;
    float visible = rise_m < 0.0 ? 0.0 : 1.0;
    vec2 place = vec2(texel);
    for (uint i = 0u; i < march.step_count && visible > 0.0; ++i) {
        place += march.sunwards;
        ray_m += rise_m;
        if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, vec2(march.size - 1u)))) {
            break;
        }
        if (textureLod(height_image, (first_row + place + 0.5) / image_size, 0.0).x > ray_m) {
            visible = 0.0;
        }
    }
    imageStore(out_visibility, stored_at, vec4(visible));
}
