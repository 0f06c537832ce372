// SPDX-License-Identifier: MIT
// One thread packs the layers of one pixel, and the radius of its circle of confusion, into one texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/lens/lens.glsl.h"

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D depth_image;
layout(binding = 1) uniform sampler2D wash_image;
layout(binding = 2) uniform sampler2D hatch_image;
layout(binding = 3) uniform sampler2D line_image;
layout(binding = 4) uniform sampler2D sky_ink_image;
layout(binding = 5, rgba32ui) writeonly uniform uimage2D out_texel;

layout(push_constant, scalar) uniform Constants
{
    LensConstants constants;
};

layout(constant_id = 0) const uint variant = 0u;
const bool has_sky = (variant & lens_has_sky) != 0u;
const bool is_wash_only = (variant & lens_wash_only) != 0u;

#include "techniques/lens/lens_texel.glsl"
#include "shaders/layers.glsl"
#include "shaders/line_owner.glsl"

// The radius of the circle of confusion is linear in reversed depth.
float radius_of(float depth)
{
    float radius = constants.radius_px - constants.radius_per_depth * depth;
    return clamp(radius, -constants.most_px, constants.most_px);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.size_px))) {
        return;
    }
    Layers layers = layers_at(pixel);
    LayerSample sample_here = sample_of_layers(layers.wash.rgb, is_wash_only ? 0.0 : layers.hatch,
                                               is_wash_only ? vec4(0.0) : layers.lines);
    ivec2 last = ivec2(constants.size_px) - 1;
    float radius = radius_of(owner_of(pixel, layers.lines.a, constants.line_reach_px, last).depth);
    imageStore(out_texel, pixel, pack_texel(LensTexel(sample_here, radius, 1.0)));
}
