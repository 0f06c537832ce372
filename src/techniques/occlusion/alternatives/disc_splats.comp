// SPDX-License-Identifier: MIT
// One thread per pixel sums the occlusion of the discs, and the light that they bounce onto the pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/unit.glsl"
#include "techniques/occlusion/alternatives/discs.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1) uniform sampler2D depth_image;
layout(binding = 2) uniform usampler2D normal_image;

layout(push_constant, scalar) uniform Constants
{
    DiscConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool bounces = (variant & discs_bounce) != 0u;

#define DISCS_BINDING 3
#define DISCS_BOUNCE bounces
#include "techniques/occlusion/alternatives/disc_sum.glsl"

layout(binding = 5, r16f) writeonly uniform image2D out_open;
layout(binding = 6, rgba16f) writeonly uniform image2D out_bounced;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 held = min(pixel, ivec2(frame.size_px) - 1);
    float depth = texelFetch(depth_image, held, 0).x;
    vec3 place = anchor_at(frame, vec2(held) + 0.5, max(depth, 1e-9));
    vec3 normal = unpack_normal(texelFetch(normal_image, held, 0).y);
    DiscSum sum = sum_of_discs(place, normal, depth > 0.0);
    if (held == pixel) {
        imageStore(out_open, pixel, vec4(pow(max(1.0 - sum.hidden, 0.0), constants.strength)));
        if (bounces) {
            imageStore(out_bounced, pixel, vec4(constants.bleeding * sum.bounced, 0.0));
        }
    }
}
